"""Figures of results with matplotlib, in the style of the program's own figures."""

from __future__ import annotations

import difflib
import weakref
from pathlib import Path
from typing import Any, Dict, List, NamedTuple, Optional, Tuple

import numpy as np

from ._errors import ResultError, needed, word_of
from ._results import Basins, Branches, Crosscheck, Gear, Map, Result, Run, Sweep, Tolerance
from ._tables import Array, Table

# Distinct in print, in grey and for colour-blind eyes; the colours of the program.
_BLUE, _RED, _GREEN, _OCHRE, _PURPLE, _GREY = "#12285c", "#c8553d", "#1b8a6b", "#b07a00", "#7a4a8c", "#4a4a4a"
_CYCLE = [_BLUE, _RED, _GREEN, _OCHRE, _PURPLE, _GREY, "#3f8fd0", "#d98cb3"]
_REGIMES: List[Tuple[str, str]] = [
    ("period 1", "#12285c"),
    ("period 2", "#3f8fd0"),
    ("period 3", "#9bd7f2"),
    ("period 4", "#6b3f8f"),
    ("period 5 to 8", "#b08fd0"),
    ("period > 8", "#e3d3f0"),
    ("quasiperiodic", "#1b8a6b"),
    ("chaotic", "#c8553d"),
    ("undecided", "#b8b8b8"),
    ("failed", "#000000"),
]
_ATTRACTORS = ["#12285c", "#c8553d", "#1b8a6b", "#e8b12a", "#3f8fd0", "#7a4a8c", "#9bd7f2", "#d98cb3", "#6b4f2a",
               "#a5c96a", "#f3dcb0", "#404a52"]
_PARAMETERS = {
    "mesh_frequency_ratio": "Mesh frequency ratio  Ω = ω$_m$ / ω$_{sn}$",
    "sun_speed_rpm": "Sun speed  n$_s$  [rpm]",
    "carrier_speed_rpm": "Carrier speed  n$_c$  [rpm]",
    "mesh_frequency_Hz": "Mesh frequency  f$_m$  [Hz]",
}
#: Letters, marker and colour of special points.
_SPECIAL: Dict[str, Tuple[str, str, str]] = {
    "fold": ("LP fold", "o", _OCHRE),
    "flip": ("PD period doubling", "s", _GREEN),
    "neimark_sacker": ("NS Neimark-Sacker", "D", _PURPLE),
    "branch_point": ("BP branch point", "^", _GREY),
    "grazing": ("grazing", ".", _GREY),
}


class _Drawn(NamedTuple):
    """What one call has drawn into axes: its name in the legend, and artists with their own labels."""

    folder: Path
    name: Optional[str]
    quantity: Optional[str]
    labels: List[Tuple[Any, str]]


_drawn: "weakref.WeakKeyDictionary[Any, List[_Drawn]]" = weakref.WeakKeyDictionary()


def plot(
    result: Result, quantity: Optional[str], ax: Optional[Any], direction: Optional[str], name: Optional[str] = None
) -> Any:
    """Draw a quantity of a result; see ``Result.plot``."""
    def drawing(axes: Any) -> None:
        if isinstance(result, Sweep):
            _sweep(result, quantity, axes, direction)
        elif isinstance(result, Map):
            _cells(result, quantity, axes, direction)
        elif isinstance(result, Branches):
            _branches(result, quantity, axes)
        elif isinstance(result, Run):
            _run(result, quantity, axes)
        elif isinstance(result, Tolerance):
            _tolerance(result, quantity, axes)
        elif isinstance(result, Crosscheck):
            _crosscheck(result, quantity, axes)
        elif isinstance(result, Gear):
            _gear(result, quantity, axes)

    if not isinstance(result, (Sweep, Map, Branches, Run, Tolerance, Crosscheck, Gear)):
        raise ResultError(f"{result.folder}: there is no figure of a {result.kind}; its tables are DataFrames")
    if ax is None:
        pyplot = needed("matplotlib.pyplot", "a figure")
        _, ax = pyplot.subplots(figsize=(7.5, 5.0), layout="constrained")
    if not hasattr(ax, "plot"):
        raise TypeError(f"ax is {type(ax).__name__}, must be Axes of matplotlib")
    if name is not None and not isinstance(name, str):
        raise TypeError(f"label is {word_of(name)}, must be a text")
    before, label = set(ax.lines), ax.get_ylabel() if _drawn.get(ax) else ""
    drawing(ax)
    if label and ax.get_ylabel() not in label.split(", "):
        ax.set_ylabel(f"{label}, {ax.get_ylabel()}")
    if not isinstance(result, Map):
        _distinguish(ax, [line for line in ax.lines if line not in before], result, name, quantity)
        if not isinstance(result, Run) or quantity is None or name is not None or len(_drawn[ax]) > 1:
            _legend(ax)
    _finish(result, ax)
    return ax


def _distinguish(ax: Any, lines: List[Any], result: Result, name: Optional[str], quantity: Optional[str]) -> None:
    """Give the lines of a result colours and labels that no other one in the axes has."""
    special = {label for label, _, _ in _SPECIAL.values()}
    drawn = _drawn.setdefault(ax, [])
    drawn[:] = [one for one in drawn if any(line in ax.lines for line, _ in one.labels)]  # not what was cleared
    if drawn:
        step = 2 * len(drawn)
        for line in lines:
            if line.get_color() in _CYCLE and line.get_label() not in special:
                line.set_color(_CYCLE[(_CYCLE.index(line.get_color()) + step) % len(_CYCLE)])
    labels = [(line, str(line.get_label())) for line in lines if not str(line.get_label()).startswith("_")]
    drawn.append(_Drawn(result.folder, name, quantity, labels))
    folders = [one.folder for one in drawn]
    for one in drawn:
        words = one.name
        if words is None and len(drawn) > 1:
            alike = any(other != one.folder and other.name == one.folder.name for other in folders)
            parts = [] if len(set(folders)) == 1 else [str(Path(*one.folder.parts[-2:])) if alike else one.folder.name]
            if folders.count(one.folder) > 1 and one.quantity is not None:
                parts.append(one.quantity)
            words = ", ".join(parts) or None
        for line, label in one.labels:
            line.set_label(label if words is None else f"{_literal(words)}: {label}")


# Axes


def _finish(result: Result, ax: Any) -> None:
    """Set ticks and title as in the figures of the program."""
    ax.tick_params(which="both", direction="in", right=True, top=not ax.child_axes)
    for axis, scale in ((ax.xaxis, ax.get_xscale()), (ax.yaxis, ax.get_yscale())):
        if scale == "linear" and not isinstance(result, Basins):
            ticker = needed("matplotlib.ticker", "a figure")
            axis.set_minor_locator(ticker.AutoMinorLocator(5))
    if not ax.get_title(loc="left"):
        ax.set_title(_literal(result.name), loc="left", fontsize="medium")


def _literal(text: str) -> str:
    """Return a text without the signs of matplotlib's formulas."""
    return "".join(c for c in text if c.isprintable()).replace("$", r"\$")


def _legend(ax: Any) -> None:
    """Place the legend above the axes, at the right end of the line of the title."""
    handles, labels = ax.get_legend_handles_labels()
    if not handles:
        return
    transforms = needed("matplotlib.transforms", "a figure")
    points = 32.0 if ax.child_axes else 2.0
    place = ax.transAxes + transforms.ScaledTranslation(0, points / 72.0, ax.figure.dpi_scale_trans)
    ax.legend(handles, labels, loc="lower right", bbox_to_anchor=(1.0, 1.0), bbox_transform=place, frameon=False,
              fontsize="small", ncol=2 if len(handles) > 3 else 4, borderaxespad=0.0, handletextpad=0.4,
              columnspacing=1.2)


def _quantity_label(name: str, table: Table) -> str:
    shown = {"delta_sp_1": "δ$_{sp,1}$", "delta_rp_1": "δ$_{rp,1}$"}.get(name, _literal(name))
    unit = table.units.get(name, "")
    if unit == "b_c":
        return f"{shown} / b$_c$"
    return shown if unit in ("", "1") else f"{shown}  [{_literal(unit.replace('tau', 'τ'))}]"


def _abscissa(result: Result) -> str:
    """Return the column that the varied parameter has in the unit of the study."""
    columns = result._table(result._points[0]).columns
    return result.parameter if result.parameter is not None and result.parameter in columns else "value"


def _parameter_label(name: Optional[str]) -> str:
    return _PARAMETERS.get(name or "", _literal((name or "value").replace("_", " ").strip("/")))


def _label_abscissa(result: Result, ax: Any) -> None:
    """Label the parameter; over the mesh frequency ratio the speed of the sun stands above."""
    ax.set_xlabel(_parameter_label(result.parameter))
    columns = result._table(result._points[0]).columns
    if _abscissa(result) != "value" or result.parameter != "mesh_frequency_ratio" or "sun_speed_rpm" not in columns:
        return
    known = np.isfinite(columns["sun_speed_rpm"]) & (columns["value"] > 0)
    if not np.any(known) or ax.child_axes:
        return
    factor = float(columns["sun_speed_rpm"][known][0] / columns["value"][known][0])
    if factor <= 0:
        return
    above = ax.secondary_xaxis("top", functions=(lambda x: x * factor, lambda x: x / factor))
    above.set_xlabel(_PARAMETERS["sun_speed_rpm"])
    above.tick_params(which="both", direction="in")


def _numbers(result: Result, table: Table, quantity: str) -> Array:
    if quantity not in table.columns:
        near = difflib.get_close_matches(quantity, table.columns) if isinstance(quantity, str) else []
        words = f"did you mean {', '.join(near)}?" if near else f"there are {', '.join(table.columns)}"
        raise ResultError(f"{result.folder}: no column {word_of(quantity)} to draw; {words}")
    values = table.columns[quantity]
    if values.dtype.kind not in "if":
        raise ResultError(f"{result.folder}: column {word_of(quantity)} has texts, not numbers")
    return values.astype(float)


# Kinds


def _sweep(result: Sweep, quantity: Optional[str], ax: Any, direction: Optional[str]) -> None:
    points = result._table("points")
    if quantity is None:
        quantity = "delta_sp_1" if "poincare" in result.tables else "lyapunov_max"
    poincare = result._table("poincare") if "poincare" in result.tables else Table({})
    is_section = quantity in poincare.columns
    x = points.columns[_abscissa(result)].astype(float)
    directions = result.directions
    if direction is not None and direction not in directions:
        raise ResultError(f"{result.folder}: has no direction {word_of(direction)}; it has {', '.join(directions)}")
    place = {number: k for k, number in enumerate(points.columns["point"])}
    for k, word in enumerate(directions):
        if direction is not None and word != direction:
            continue
        colour = [_BLUE, _RED][k % 2]
        here = points.columns["direction"] == word
        if is_section:
            rows = np.array([place[n] for n in poincare.columns["point"]], dtype=np.int64)
            chosen = here[rows]
            y = _numbers(result, poincare, quantity)[chosen]
            # A coarse grid has larger dots; the second direction has smaller ones, on the first. Many become pixels.
            size = (2.2 if np.count_nonzero(here) > 150 else 5.0) * (1.0 if k == 0 or direction is not None else 0.6)
            ax.plot(x[rows][chosen], y, linestyle="none", marker=".", markersize=size, markeredgewidth=0, color=colour,
                    rasterized=len(y) > 20000, zorder=3 + 0.1 * k)
            ax.plot([], [], linestyle="none", marker=".", markersize=8, color=colour, label=word)
        else:
            y = _numbers(result, points, quantity)
            order = np.flatnonzero(here)[np.argsort(x[here], kind="stable")]
            regular = np.isin(points.columns["regime"][order].astype(str), ["periodic", "quasiperiodic"])
            ax.plot(x[order], np.where(regular, y[order], np.nan), color=colour, linewidth=1.3, marker=".",
                    markersize=2.5, label=word, zorder=3 - 0.1 * k)
            if not np.all(regular):
                ax.plot(x[order][~regular], y[order][~regular], linestyle="none", marker="o", markersize=3.2,
                        markerfacecolor="none", markeredgewidth=0.8, color=colour,
                        label=f"{word}, chaotic or undecided")
    finite = x[np.isfinite(x)]
    if len(finite) and finite.min() < finite.max():
        ax.set_xlim(finite.min(), finite.max())
    _label_abscissa(result, ax)
    label = _quantity_label(quantity, poincare if is_section else points)
    ax.set_ylabel(f"Poincaré points of  {label}" if is_section else label)


def _edges(values: Array) -> Array:
    """Return the edges of cells around ascending values: shape (n + 1,)."""
    if len(values) == 1:
        half = 0.5 if values[0] == 0 else 0.05 * abs(values[0])
        return np.array([values[0] - half, values[0] + half])
    middle = 0.5 * (values[1:] + values[:-1])
    return np.concatenate([[2 * values[0] - middle[0]], middle, [2 * values[-1] - middle[-1]]])


def _cells(result: Map, quantity: Optional[str], ax: Any, direction: Optional[str]) -> None:
    table = result._table("points")
    directions = list(dict.fromkeys(table.columns["direction"]))
    if direction is None:
        direction = directions[0]
    if direction not in directions:
        raise ResultError(f"{result.folder}: has no direction {word_of(direction)}; it has {', '.join(directions)}")
    part = table.rows(np.flatnonzero(table.columns["direction"] == direction))
    first, second = np.unique(part.columns["value"]), np.unique(part.columns["second_value"])
    row = np.searchsorted(second, part.columns["second_value"])
    column = np.searchsorted(first, part.columns["value"])

    def placed(values: Array) -> Array:
        matrix: Array = np.full((len(second), len(first)), np.nan)
        matrix[row, column] = values
        return matrix

    if quantity is None and isinstance(result, Basins):
        classes = _attractor_classes(result, part)
        _classes(ax, first, second, placed(part.columns["attractor"].astype(float)), classes)
    elif quantity is None or quantity == "regime":
        colours = [(float(k), label, colour) for k, (label, colour) in enumerate(_REGIMES)]
        _classes(ax, first, second, placed(_regime_numbers(part)), colours)
    else:
        values = placed(_numbers(result, part, quantity))
        mesh = ax.pcolormesh(_edges(first), _edges(second), values, cmap="viridis", rasterized=True)
        ax.figure.colorbar(mesh, ax=ax, label=_quantity_label(quantity, part))
    names = [_component_label(n) if isinstance(result, Basins) else _parameter_label(n) for n in result.axis_names]
    ax.set_xlabel(names[0])
    ax.set_ylabel(names[1])
    if len(directions) > 1:
        ax.set_title(f"{_literal(result.name)}, {direction}", loc="left", fontsize="medium")


def _component_label(name: str) -> str:
    rate = name.endswith("_rate")
    letter, _, body = (name[:-5] if rate else name).partition("_")
    symbol = f"{letter}$_{{{_literal(body)}}}$"
    return f"Initial  d{symbol}/dτ / b$_c$" if rate else f"Initial  {symbol} / b$_c$"


def _regime_numbers(table: Table) -> Array:
    """Return the place of each row in ``_REGIMES``: float array of shape (rows,)."""
    words = [label for label, _ in _REGIMES]
    numbers = []
    for status, regime, period in zip(
        table.columns["status"], table.columns["regime"], table.columns["period"].astype(float)
    ):
        if status != "ok":
            numbers.append(words.index("failed"))
        elif regime == "periodic":
            numbers.append(int(period) - 1 if period <= 4 else 4 if period <= 8 else 5)
        else:
            numbers.append(words.index(regime) if regime in words else words.index("undecided"))
    return np.array(numbers, dtype=float)


def _attractor_classes(result: Basins, part: Table) -> List[Tuple[float, str, str]]:
    attractors = result._table("attractors").columns
    classes: List[Tuple[float, str, str]] = [(0.0, "undecided or failed", "#9a9a9a")]
    for k, number in enumerate(attractors["attractor"]):
        regime, period = attractors["regime"][k], int(attractors["period"][k])
        word = f"period {period}" if regime == "periodic" else str(regime)
        share = 100.0 * float(np.mean(part.columns["attractor"] == number))
        text = "< 1 %" if share < 1.0 else f"{share:.0f} %"
        colour = _ATTRACTORS[k] if k < len(_ATTRACTORS) else "#dedede"
        classes.append((float(number), f"{number}: {word}, {text}", colour))
    return classes


def _classes(ax: Any, first: Array, second: Array, numbers: Array, classes: List[Tuple[float, str, str]]) -> None:
    """Draw cells of classes with a legend of those that occur."""
    colors = needed("matplotlib.colors", "a figure")
    patches = needed("matplotlib.patches", "a figure")
    place = {number: k for k, (number, _, _) in enumerate(classes)}
    indices = np.array([[place.get(v, np.nan) for v in line] for line in numbers], dtype=float)
    colour_map = colors.ListedColormap([colour for _, _, colour in classes])
    ax.pcolormesh(_edges(first), _edges(second), indices, cmap=colour_map, vmin=-0.5, vmax=len(classes) - 0.5,
                  rasterized=True)
    seen = set(indices[np.isfinite(indices)].astype(int))
    handles = [
        patches.Patch(facecolor=colour, edgecolor=_GREY, linewidth=0.5, label=label)
        for k, (_, label, colour) in enumerate(classes)
        if k in seen
    ]
    ax.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.01, 1.0), frameon=False, fontsize="small",
              borderaxespad=0.0)


def _branches(result: Branches, quantity: Optional[str], ax: Any) -> None:
    orbits = result._table("branch")
    poincare = result._table("poincare")
    if quantity is None:
        quantity = "delta_sp_1"
    is_section = quantity in poincare.columns
    x_name = _abscissa(result)
    special = result._table("special").columns if "special" in result.tables else {}
    places: Dict[str, List[Tuple[float, float]]] = {}
    lines: Dict[bool, List[Tuple[Array, Array]]] = {True: [], False: []}
    for branch in np.unique(orbits.columns["branch"]):
        rows = np.flatnonzero(orbits.columns["branch"] == branch)
        x = orbits.columns[x_name][rows].astype(float)
        stable = orbits.columns["stable"][rows].astype(int) == 1
        if is_section:
            curves = _crossings(_numbers(result, poincare, quantity), poincare, branch, orbits.columns["index"][rows])
        else:
            curves = [_numbers(result, orbits, quantity)[rows]]
        changes = _changes(special, branch, orbits.columns["index"][rows], x, x_name)
        for y in curves:
            _split(x, y, stable, changes, lines)
        for kind, k, fraction in changes:
            y = curves[0]
            value = (x[k] + fraction * (x[k + 1] - x[k]), y[k] + fraction * (y[k + 1] - y[k]))
            places.setdefault(kind, []).append(value)
    styles: Dict[bool, Dict[str, Any]] = {
        False: {"color": _RED, "linewidth": 1.0, "linestyle": (0, (5, 3)), "label": "unstable"},
        True: {"color": _BLUE, "linewidth": 1.5, "label": "stable"},
    }
    for kind_stable in (False, True):
        parts = lines[kind_stable]
        if parts:
            gap = np.array([np.nan])
            ax.plot(np.concatenate([np.append(p[0], gap) for p in parts]),
                    np.concatenate([np.append(p[1], gap) for p in parts]), **styles[kind_stable])
    for kind, (label, marker, colour) in _SPECIAL.items():
        if kind in places:
            here = np.array(places[kind])
            ax.plot(here[:, 0], here[:, 1], linestyle="none", marker=marker, markersize=6 if kind != "grazing" else 5,
                    color=colour, markeredgecolor="white", markeredgewidth=0.6, label=label, zorder=3)
    _label_abscissa(result, ax)
    label = _quantity_label(quantity, poincare if is_section else orbits)
    ax.set_ylabel(f"Poincaré points of  {label}" if is_section else label)


def _crossings(values: Array, poincare: Table, branch: int, indices: Array) -> List[Array]:
    """Return one curve for each Poincaré point of an orbit: arrays of shape (orbits,)."""
    columns = poincare.columns
    here = columns["branch"] == branch
    place = {index: k for k, index in enumerate(indices)}
    count = int(columns["crossing"][here].max(initial=-1)) + 1
    curves = np.full((count, len(indices)), np.nan)
    for row in np.flatnonzero(here):
        if columns["index"][row] in place:
            curves[columns["crossing"][row], place[columns["index"][row]]] = values[row]
    return list(curves)


def _changes(special: Dict[str, Array], branch: int, indices: Array, x: Array,
             x_name: str) -> List[Tuple[str, int, float]]:
    """Return kind, number of the orbit before and fraction of the step to the next, for special points of a branch."""
    found = []
    for k in np.flatnonzero(special.get("branch", np.array([])) == branch):
        before = np.flatnonzero(indices == special["after"][k])
        value = float(special[x_name if x_name in special else "value"][k])
        if len(before) == 0 or before[0] + 1 >= len(x):
            continue
        j = int(before[0])
        step = x[j + 1] - x[j]
        fraction = (value - x[j]) / step if step != 0 else 0.5
        # Beside a fold both orbits are on one side of it.
        found.append((str(special["kind"][k]), j, float(fraction) if 0.0 <= fraction <= 1.0 else 0.5))
    return found


def _split(x: Array, y: Array, stable: Array, changes: List[Tuple[str, int, float]],
           lines: Dict[bool, List[Tuple[Array, Array]]]) -> None:
    """Add the parts of a curve to the lines of stable and of unstable orbits."""
    fractions = {k: fraction for kind, k, fraction in changes if kind != "grazing"}
    begin_x, begin_y = [x[0]], [y[0]]
    for k in range(len(x) - 1):
        if stable[k] == stable[k + 1]:
            begin_x.append(x[k + 1])
            begin_y.append(y[k + 1])
            continue
        fraction = fractions.get(k, 0.5)
        middle = (x[k] + fraction * (x[k + 1] - x[k]), y[k] + fraction * (y[k + 1] - y[k]))
        lines[bool(stable[k])].append((np.array(begin_x + [middle[0]]), np.array(begin_y + [middle[1]])))
        begin_x, begin_y = [middle[0], x[k + 1]], [middle[1], y[k + 1]]
    lines[bool(stable[-1])].append((np.array(begin_x), np.array(begin_y)))


def _run(result: Run, quantity: Optional[str], ax: Any) -> None:
    table = result._table("history")
    quantities = ["delta_sp_1", "delta_rp_1"] if quantity is None else [quantity]
    for k, name in enumerate(quantities):
        ax.plot(table.columns["periods"], _numbers(result, table, name), color=_CYCLE[k], linewidth=1.3,
                label=_quantity_label(name, table).split(" /")[0])
    ax.set_xlabel("Time in mesh periods")
    ax.set_ylabel("Deflection / b$_c$" if quantity is None else _quantity_label(quantity, table))
    ax.margins(x=0)


def _by_word(ax: Any, table: Table, word: str, x: Array, y: Array, linewidth: float) -> None:
    """Draw markers, and a line through them, for each text of a column; only positive values."""
    for k, text in enumerate(dict.fromkeys(table.columns[word])):
        here = np.flatnonzero((table.columns[word] == text) & (x > 0) & (y > 0))
        here = here[np.argsort(x[here], kind="stable")]
        ax.plot(x[here], y[here], color=_CYCLE[k % len(_CYCLE)], marker="osD^v<>ph"[k % 9], markersize=4,
                linewidth=linewidth, label=_literal(str(text)))


def _tolerance(result: Tolerance, quantity: Optional[str], ax: Any) -> None:
    table = result._table("tolerance")
    quantity = quantity or "orbit_error"
    _by_word(ax, table, "method", _numbers(result, table, "rhs_evaluations"), _numbers(result, table, quantity), 1.0)
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlabel("Evaluations of the right-hand side")
    ax.set_ylabel("Error of the orbit  [b$_c$, b$_c$ per τ]" if quantity == "orbit_error" else _literal(quantity))


def _crosscheck(result: Crosscheck, quantity: Optional[str], ax: Any) -> None:
    table = result._table("crosscheck")
    quantity = quantity or "orbit_distance"
    _by_word(ax, table, "variant", _numbers(result, table, "value"), _numbers(result, table, quantity), 0.0)
    ax.set_yscale("log")
    ax.set_xlabel(_PARAMETERS["mesh_frequency_ratio"] if result.parameter in _PARAMETERS else
                  _parameter_label(result.parameter))
    ax.set_ylabel("Distance of the orbits  [b$_c$, b$_c$ per τ]" if quantity == "orbit_distance" else
                  _literal(quantity))


def _gear(result: Gear, quantity: Optional[str], ax: Any) -> None:
    table = result._table("stiffness")
    names = {"k_sp_N_per_m": "sun-planet mesh", "k_rp_N_per_m": "ring-planet mesh"} if quantity is None else {
        quantity: quantity}
    for k, (name, label) in enumerate(names.items()):
        ax.plot(table.columns["phase"], 1e-9 * _numbers(result, table, name), color=_CYCLE[k], linewidth=1.4,
                label=_literal(label))
    ax.set_xlabel("Mesh phase  [mesh periods]")
    ax.set_ylabel("Mesh stiffness  [10$^9$ N/m]")
    ax.margins(x=0)
