// Sweeps and branches over one parameter: the bifurcation diagram or a response curve, under it exponent and multiplier
// on the same abscissa, and beside it what is known of the point that was chosen.
import { Panel, Raster, View, dot, rangeOf, strokeLine } from './panel.js';
import { theme } from './theme.js';
import { axisLabel, capital, element, factorOf, lengthUnit, number, symbol, unitText, withError } from './words.js';
import { orbitDetails, pointDetails, showDetails, specialDetails } from './details.js';
import { changesTable, specialTable } from './changes.js';
import { quantityChooser } from './choice.js';

export const classNames = [
  'period 1',
  'period 2 and more',
  'quasiperiodic',
  'chaotic',
  'undecided',
  'record not converged to the orbit',
];
export const specialNames = new Map(
  Object.entries({
    fold: ['LP', 'fold (saddle-node)'],
    flip: ['PD', 'period doubling (flip)'],
    neimark_sacker: ['NS', 'Neimark-Sacker (torus)'],
    branch_point: ['BP', 'branch point'],
    grazing: ['G', 'grazing of a contact'],
    unresolved: ['?', 'not resolved'],
  }),
);
export const specialName = (kind) =>
  specialNames.get(kind) ?? [kind.replace('resonance_', 'R').replace('_', ':'), kind.replace(/_/g, ' ')];

/// The column that says whether a record has converged to the orbit.
const convergedColumn = (table) => ['converged', 'settled'].find((name) => table.has(name));

/// The class of each row of points.csv; −1 of a point that was not reached.
export function classesOf(table) {
  const period = table.numbers('period');
  const converged = convergedColumn(table) ? table.numbers(convergedColumn(table)) : null;
  return Int8Array.from({ length: table.rows }, (_, row) => {
    if (table.has('status') && table.word('status', row) !== 'ok') return -1;
    if (converged && converged[row] !== 1) return 5;
    const regime = table.word('regime', row);
    if (regime === 'periodic') return period[row] <= 1 ? 0 : 1;
    return regime === 'quasiperiodic' ? 2 : regime === 'chaotic' ? 3 : 4;
  });
}

/// The column with the error of a column, if there is one.
export const errorOf = (table, name) =>
  [`${name}_error`, name.replace(/_max$/, '_error')].find((other) => other !== name && table.isNumeric(other));

/// Rows of one direction of a sweep or of one branch, in the order of the table.
function linesOf(study) {
  if (study.kind === 'continue') {
    const table = study.table('branch.csv');
    if (!table) return [];
    const branch = table.numbers('branch');
    const lines = new Map();
    for (let row = 0; row < table.rows; ++row) {
      if (!lines.has(branch[row])) lines.set(branch[row], []);
      lines.get(branch[row]).push(row);
    }
    return [...lines].map(([of, rows]) => ({ study, table, rows, branch: of, name: `branch ${of}`, shown: true }));
  }
  const table = study.table('points.csv');
  const lines = new Map();
  for (let row = 0; row < table.rows; ++row) {
    const direction = table.word('direction', row);
    if (!lines.has(direction)) lines.set(direction, []);
    lines.get(direction).push(row);
  }
  const value = table.numbers('value');
  return [...lines].map(([direction, rows]) => ({
    study,
    table,
    direction,
    name: direction,
    shown: true,
    classes: classesOf(table),
    rows: rows.sort((a, b) => value[a] - value[b]),
  }));
}

/// A line of a study is the same when the study has more points.
const keyOf = ({ study, name }) => `${study.folder}:${name}`;

/// Abscissae that all lines have: the parameter, and speeds where it is the speed.
function abscissae(lines, parameter) {
  const all = [{ name: 'value', label: parameter.label }];
  if (parameter.is_speed)
    for (const name of ['sun_speed_rpm', 'carrier_speed_rpm', 'mesh_frequency_Hz']) {
      const known = lines.every(({ table, rows }) => table.isNumeric(name) && table.numbers(name)[rows[0]] > 0);
      if (known)
        all.push({ name, label: `${capital(lines[0].table.byName.get(name).meaning)}  [${name.split('_').pop()}]` });
    }
  return all;
}

/// Quantities of the ordinate: columns of the Poincaré section, then numbers of the table.
function quantitiesOf(lines) {
  const sections = [];
  const curves = [];
  const skipped = new Set(['point', 'value', 'branch', 'index', 'second_value']);
  for (const { study, table } of lines) {
    for (const column of study.table('section')?.columns ?? [])
      if (!sections.some(({ name }) => name === column.name)) sections.push(column);
    for (const column of table.columns)
      if (column.form !== 'words' && !skipped.has(column.name) && !curves.some(({ name }) => name === column.name))
        curves.push(column);
  }
  return { sections, curves };
}

export class Diagram {
  /// @param memory  by remember(), of a diagram of the same studies when they had fewer points
  constructor(studies, host, memory) {
    this.lines = studies.flatMap(linesOf).filter(({ rows }) => rows.length > 0);
    this.toggled = memory?.toggled ?? new Map(); // by the reader
    for (const line of this.lines) line.shown = this.toggled.get(keyOf(line)) ?? line.study.shown ?? true;
    this.studies = studies;
    this.parameter = studies[0].parameter;
    this.axes = abscissae(this.lines, this.parameter);
    this.axis = this.axes[0];
    this.quantities = quantitiesOf(this.lines);
    const first = this.quantities.sections.find(({ name }) => name === 'delta_sp_1') ?? this.quantities.sections[0];
    this.quantity =
      first ?? this.quantities.curves.find(({ name }) => name === 'delta_sp_rms') ?? this.quantities.curves[0];
    this.bySection = Boolean(first);
    this.colourBy = this.lines.some(({ classes }) => classes) ? 'regime' : 'line';
    this.chosen = null;
    this.special = studies.filter(({ kind }) => kind === 'continue').flatMap((study) => this.specialOf(study));
    if (memory) this.recall(memory);
    this.build(host, memory);
  }

  /// What a reader has chosen.
  remember() {
    const { x, full } = this.view;
    return {
      toggled: this.toggled,
      axis: this.axis.name,
      bySection: this.bySection,
      quantity: this.quantity?.name,
      colourBy: this.colourBy,
      view: x[0] === full[0] && x[1] === full[1] ? null : x,
      y: this.main.y,
      chosen: this.chosen && {
        key: keyOf(this.chosen.line),
        at: this.chosen.line.table.numbers('value')[this.chosen.row],
      },
      details: this.details,
    };
  }

  recall(memory) {
    const columns = memory.bySection ? this.quantities.sections : this.quantities.curves;
    const quantity = columns.find(({ name }) => name === memory.quantity);
    if (quantity) [this.bySection, this.quantity] = [memory.bySection, quantity];
    this.axis = this.axes.find(({ name }) => name === memory.axis) ?? this.axes[0];
    if (this.lines.some(({ classes }) => classes)) this.colourBy = memory.colourBy;
    const line = memory.chosen && this.lines.find((one) => keyOf(one) === memory.chosen.key);
    if (!line) return;
    const row = line.rows.find((one) => line.table.numbers('value')[one] === memory.chosen.at);
    if (row !== undefined) this.chosen = { line, row };
  }

  /// What is visible, in values of the parameter.
  shownRange(x = this.view.x) {
    const within = this.ends();
    const shown = [Math.max(x[0], within[0]), Math.min(x[1], within[1])];
    if (this.axis.name === 'value') return shown;
    // Speeds are proportional to each other.
    const { table, rows } = this.lines[0];
    const factor = table.numbers('value')[rows[0]] / table.numbers(this.axis.name)[rows[0]];
    return shown.map((value) => value * factor);
  }

  // ---- values ---------------------------------------------------------------------------------------------------

  x(line) {
    return line.table.numbers(this.axis.name);
  }

  factor() {
    return factorOf(this.quantity.unit);
  }

  /// Values of the section that is drawn, and where those of each row begin.
  section(line) {
    const table = line.study.table('section');
    const starts = line.study.table('section_starts');
    if (!this.bySection || !table?.has(this.quantity.name) || !starts) return null;
    return { values: table.numbers(this.quantity.name), starts: starts.numbers('start') };
  }

  curve(line, name = this.quantity.name) {
    return line.table.isNumeric(name) ? line.table.numbers(name) : null;
  }

  /// Least and largest abscissa.
  ends() {
    let [low, high] = [Infinity, -Infinity];
    for (const line of this.lines)
      for (const row of line.rows) {
        const x = this.x(line)[row];
        if (Number.isFinite(x)) [low, high] = [Math.min(low, x), Math.max(high, x)];
      }
    return [low, high];
  }

  full() {
    return rangeOf(...this.ends(), 0.01);
  }

  /// Of what is visible.
  range([x0, x1]) {
    let [low, high] = [Infinity, -Infinity];
    const take = (value) => {
      if (value < low) low = value;
      if (value > high) high = value;
    };
    const factor = this.factor();
    for (const line of this.lines) {
      if (!line.shown) continue;
      const xs = this.x(line);
      const section = this.section(line);
      const values = section ? null : this.bySection ? null : this.curve(line);
      for (const row of line.rows) {
        if (!(xs[row] >= x0 && xs[row] <= x1) || line.classes?.[row] === -1) continue;
        if (section) for (let k = section.starts[row]; k < section.starts[row + 1]; ++k) take(section.values[k]);
        else if (values) take(values[row]);
      }
    }
    return rangeOf(factor * low, factor * high, 0.04);
  }

  rangeBelow(name, [x0, x1], most) {
    let [low, high] = most ? [1, 0] : [0, 0];
    for (const line of this.lines) {
      const values = line.shown && this.curve(line, name);
      if (!values) continue;
      const xs = this.x(line);
      const errors = errorOf(line.table, name) ? line.table.numbers(errorOf(line.table, name)) : null;
      for (const row of line.rows)
        if (xs[row] >= x0 && xs[row] <= x1 && Number.isFinite(values[row])) {
          const error = errors && line.classes?.[row] > 1 && errors[row] > 0 ? errors[row] : 0;
          low = Math.min(low, values[row] - error);
          if (!(most && values[row] > most)) high = Math.max(high, values[row] + error);
        }
    }
    return rangeOf(low, high, 0.06);
  }

  specialOf(study) {
    const table = study.table('special.csv');
    const branches = study.table('branch.csv');
    if (!table || !branches) return [];
    const rowOf = new Map();
    for (let row = 0; row < branches.rows; ++row)
      rowOf.set(`${branches.numbers('branch')[row]}:${branches.numbers('index')[row]}`, row);
    return Array.from({ length: table.rows }, (_, row) => {
      const branch = table.numbers('branch')[row];
      const after = table.numbers('after')[row];
      const [before, next] = [rowOf.get(`${branch}:${after}`), rowOf.get(`${branch}:${after + 1}`)];
      return {
        study,
        row,
        kind: table.word('kind', row),
        branch,
        before,
        next: next ?? before,
        value: table.numbers('value')[row],
      };
    }).filter(({ before, row }) => before !== undefined && !table.word('same_as', row));
  }

  /// Where special points are drawn: between the two orbits around them.
  placesOf(point) {
    const line = this.lines.find(({ study, branch }) => study === point.study && branch === point.branch);
    if (!line?.shown) return [];
    const value = line.table.numbers('value');
    const [a, b] = [point.before, point.next];
    const part = value[b] === value[a] ? 0 : Math.min(1, Math.max(0, (point.value - value[a]) / (value[b] - value[a])));
    const mixed = (values, i, j) => values[i] + part * (values[j] - values[i]);
    const x = mixed(this.x(line), a, b);
    const section = this.section(line);
    const values = this.bySection ? null : this.curve(line);
    if (values) return [[x, this.factor() * mixed(values, a, b)]];
    if (!section) return [];
    const count = Math.min(section.starts[a + 1] - section.starts[a], section.starts[b + 1] - section.starts[b]);
    return Array.from({ length: count }, (_, k) => [
      x,
      this.factor() * mixed(section.values, section.starts[a] + k, section.starts[b] + k),
    ]);
  }

  // ---- drawing --------------------------------------------------------------------------------------------------

  /// Which of the colours a line has that is not coloured by regime. Branches over a sweep have those that no regime has.
  seriesOf(line) {
    if (line.branch === undefined) return this.lines.indexOf(line) % 10;
    const apart = [4, 7, 9, 8, 5];
    const place = this.lines.filter(({ branch }) => branch !== undefined).indexOf(line);
    return this.lines.some(({ classes }) => classes) ? apart[place % apart.length] : place % 10;
  }

  colour(line, row) {
    if (line.branch !== undefined) return theme().series[this.seriesOf(line)];
    if (this.colourBy === 'regime') return theme().classes[line.classes[row]];
    return theme().series[this.seriesOf(line)];
  }

  /// The points and the lines that join them. They are the same until something else than the choice changes.
  dots(place, factor) {
    const { left, top, width, height, xRange, yRange, logarithmic } = place;
    const palette = [...theme().classes, ...theme().series];
    const shown = this.lines.map((line) => line.shown);
    const names = [this.axis.name, this.quantity?.name, this.bySection, this.colourBy];
    const state = JSON.stringify([
      left,
      top,
      width,
      height,
      xRange,
      yRange,
      logarithmic,
      factor,
      names,
      palette,
      shown,
    ]);
    if (this.made?.state === state) return this.made;
    const raster = new Raster(place);
    const joined = [];
    for (const line of this.lines) {
      if (!line.shown || line.branch !== undefined) continue;
      const xs = this.x(line);
      const section = this.section(line);
      const own = theme().classes.length + this.seriesOf(line);
      const colourOf = (row) => (this.colourBy === 'regime' ? line.classes[row] : own);
      if (section) {
        for (const row of line.rows) {
          if (line.classes[row] === -1) continue;
          const colour = colourOf(row);
          for (let k = section.starts[row]; k < section.starts[row + 1]; ++k)
            raster.add(xs[row], factor * section.values[k], colour);
        }
      } else if (!this.bySection) {
        const values = this.curve(line);
        if (!values) continue;
        const regular = (row) => line.classes[row] >= 0 && line.classes[row] <= 2;
        joined.push([
          line.rows.map((row) => xs[row]),
          line.rows.map((row) => (regular(row) ? factor * values[row] : NaN)),
          line,
        ]);
        for (const row of line.rows)
          if (line.classes[row] !== -1) raster.add(xs[row], factor * values[row], colourOf(row));
      }
    }
    raster.render(palette);
    this.made = { state, raster, joined };
    return this.made;
  }

  draw(context, place) {
    const factor = this.factor();
    const { raster, joined } = this.dots(place, factor);
    for (const [xs, ys, line] of joined)
      strokeLine(context, place, xs, ys, {
        colour: this.colourBy === 'regime' ? theme().faint : this.colour(line, 0),
        width: 0.8,
      });
    raster.paint(context);
    if (!this.bySection && this.quantity && raster.drawn < 800)
      this.drawBars(context, place, this.quantity.name, factor);
    for (const line of this.lines)
      if (line.shown && line.branch !== undefined) this.drawBranch(context, place, line, factor);
    const labels = [];
    for (const point of this.special) this.drawSpecial(context, place, point, labels);
    this.drawChosen(context, place, (line, row) => {
      const section = this.section(line);
      if (section)
        return Array.from(section.values.subarray(section.starts[row], section.starts[row + 1]), (y) => factor * y);
      const values = this.bySection ? null : this.curve(line);
      return values ? [factor * values[row]] : [];
    });
  }

  drawBars(context, place, name, factor = 1) {
    for (const line of this.lines) {
      if (!line.shown) continue;
      const values = this.curve(line, name);
      const error = errorOf(line.table, name);
      if (!values || !error) continue;
      const errors = line.table.numbers(error);
      const xs = this.x(line);
      for (const row of line.rows) {
        if (!(errors[row] > 0) || xs[row] < place.xRange[0] || xs[row] > place.xRange[1]) continue;
        // The exponent of a periodic orbit is that of its multiplier: its interval would hide the others.
        if (name === 'lyapunov_max' && line.classes?.[row] <= 1) continue;
        context.strokeStyle = this.colour(line, row);
        context.lineWidth = place.ratio;
        context.beginPath();
        context.moveTo(place.x(xs[row]), place.y(factor * (values[row] - errors[row])));
        context.lineTo(place.x(xs[row]), place.y(factor * (values[row] + errors[row])));
        context.stroke();
      }
    }
  }

  drawBranch(context, place, line, factor) {
    const xs = this.x(line);
    const stable = line.table.numbers('stable');
    const section = this.section(line);
    const values = this.bySection ? null : this.curve(line);
    if (!section && !values) return;
    const crossings = section ? Math.max(...line.rows.map((row) => section.starts[row + 1] - section.starts[row])) : 1;
    for (let k = 0; k < crossings; ++k) {
      const y = (row) =>
        section
          ? k < section.starts[row + 1] - section.starts[row]
            ? section.values[section.starts[row] + k]
            : NaN
          : values[row];
      // A line changes where stability does; both kinds meet at the orbit before the change.
      for (const kind of [1, 0]) {
        const ys = line.rows.map((row, i) => {
          const here =
            stable[row] === kind ||
            (kind === 0 && i > 0 && stable[line.rows[i - 1]] === 0) ||
            (kind === 0 && i + 1 < line.rows.length && stable[line.rows[i + 1]] === 0);
          return here ? factor * y(row) : NaN;
        });
        strokeLine(
          context,
          place,
          line.rows.map((row) => xs[row]),
          ys,
          { colour: this.colour(line), width: kind ? 2 : 1.3, dash: kind ? [] : [5, 4] },
        );
      }
    }
  }

  /// @param labels  places of labels that are drawn already: none is drawn over another
  drawSpecial(context, place, point, labels) {
    for (const [x, y] of this.placesOf(point)) {
      const [px, py] = [place.x(x), place.y(y)];
      const isChosen = point === this.chosenSpecial;
      dot(context, px, py, (isChosen ? 6 : 4) * place.ratio, isChosen ? theme().mark : theme().paper, theme().ink);
      const text = specialName(point.kind)[0];
      const [wide, tall] = [20 * place.ratio, 13 * place.ratio];
      if (labels.some(([a, b]) => Math.abs(a - px) < wide && Math.abs(b - py) < tall)) continue;
      labels.push([px, py]);
      context.font = `${11 * place.ratio}px system-ui, sans-serif`;
      context.lineWidth = 3 * place.ratio;
      context.strokeStyle = theme().paper;
      context.strokeText(text, px + 6 * place.ratio, py - 6 * place.ratio);
      context.fillStyle = theme().ink;
      context.fillText(text, px + 6 * place.ratio, py - 6 * place.ratio);
    }
  }

  drawChosen(context, place, valuesOf) {
    if (!this.chosen || !this.chosen.line.shown) return;
    const { line, row } = this.chosen;
    const x = place.x(this.x(line)[row]);
    context.strokeStyle = theme().mark;
    context.lineWidth = place.ratio;
    context.setLineDash([3 * place.ratio, 3 * place.ratio]);
    context.beginPath();
    context.moveTo(x, place.top);
    context.lineTo(x, place.top + place.height);
    context.stroke();
    context.setLineDash([]);
    // Circles around few places; more of them would hide the points.
    const values = [...new Map(valuesOf(line, row).map((y) => [y.toPrecision(4), y])).values()];
    if (values.length <= 32) for (const y of values) dot(context, x, place.y(y), 3.5 * place.ratio, null, theme().mark);
  }

  /// Exponent or multiplier: a dot for each point, with its error.
  drawBelow(context, place, name, limit) {
    context.strokeStyle = theme().faint;
    context.lineWidth = place.ratio;
    context.beginPath();
    context.moveTo(place.left, place.y(limit));
    context.lineTo(place.left + place.width, place.y(limit));
    context.stroke();
    this.drawBars(context, place, name);
    const raster = new Raster(place);
    const palette = [...theme().classes, ...theme().series];
    for (const line of this.lines) {
      const values = line.shown && this.curve(line, name);
      if (!values) continue;
      const xs = this.x(line);
      if (line.branch !== undefined) {
        strokeLine(
          context,
          place,
          line.rows.map((row) => xs[row]),
          line.rows.map((row) => values[row]),
          { colour: this.colour(line) },
        );
        continue;
      }
      const own = theme().classes.length + this.seriesOf(line);
      for (const row of line.rows)
        if (line.classes?.[row] !== -1)
          raster.add(xs[row], values[row], line.classes && this.colourBy === 'regime' ? line.classes[row] : own);
    }
    raster.render(palette);
    raster.paint(context);
    this.drawChosen(context, place, (line, row) => (this.curve(line, name) ? [this.curve(line, name)[row]] : []));
  }

  // ---- hover, choice, keys --------------------------------------------------------------------------------------

  nearest({ left, top, x, y, ratio, xAt, topOfPlot }, valuesOf) {
    const at = xAt(left);
    let best = null;
    const px = (value) => x(value) / ratio;
    for (const line of this.lines) {
      if (!line.shown) continue;
      const xs = this.x(line);
      const rows = line.branch === undefined ? around(line.rows, xs, at) : line.rows;
      for (const row of rows) {
        if (line.classes?.[row] === -1) continue;
        const dx = px(xs[row]) - px(at);
        if (Math.abs(dx) > 30) continue;
        for (const value of valuesOf(line, row)) {
          const dy = (y(value) - topOfPlot) / ratio - top;
          const apart = dx * dx + dy * dy;
          if (!best || apart < best.apart) best = { line, row, apart, value };
        }
      }
    }
    return best && best.apart < 900 ? best : null;
  }

  hover(place, valuesOf, quantity) {
    const special = quantity === this.quantity ? this.nearSpecial(place) : null;
    if (special) return special;
    const found = this.nearest(place, valuesOf);
    if (!found) return null;
    const { line, row, value } = found;
    const at = `${this.axis.name === 'value' ? this.parameter.symbol : this.axis.label.split('  ')[0]} = ${number(this.x(line)[row], 6)}`;
    const unit = unitText(quantity.unit);
    const what = `${symbol(quantity.name) || quantity.name} = ${number(value, 6)}${unit ? ` ${unit}` : ''}`;
    const kind =
      line.branch !== undefined
        ? `branch ${line.branch}, period ${line.table.numbers('period')[row]}, ${line.table.numbers('stable')[row] === 1 ? 'stable' : 'unstable'}`
        : `${line.direction}, ${this.regimeWords(line, row)}`;
    return { line, row, text: `${at}\n${what}\n${kind}` };
  }

  nearSpecial(place) {
    for (const point of this.special)
      for (const [x, y] of this.placesOf(point)) {
        const dx = (place.x(x) - place.leftOfPlot) / place.ratio - place.left;
        const dy = (place.y(y) - place.topOfPlot) / place.ratio - place.top;
        if (dx * dx + dy * dy < 64) {
          const table = point.study.table('special.csv');
          return {
            special: point,
            text: `${capital(specialName(point.kind)[1])}\n${this.parameter.symbol} = ${withError(point.value, table.numbers('error_bound')[point.row])}`,
          };
        }
      }
    return null;
  }

  regimeWords(line, row) {
    const of = line.classes[row];
    if (of === -1) return 'not reached';
    const regime = line.table.word('regime', row);
    const words = regime === 'periodic' ? `period ${line.table.numbers('period')[row]}` : regime;
    return of === 5 ? `${words}, record not converged` : words;
  }

  choose(found) {
    if (!found) return;
    this.chosenSpecial = found.special ?? null;
    if (found.special) {
      this.chosen = null;
      showDetails(this.details, specialDetails(this, found.special));
      const place = this.placesOf(found.special)[0];
      if (place) this.bringIntoView(place[0]);
      return;
    }
    this.chosen = { line: found.line, row: found.row };
    const { line, row } = this.chosen;
    showDetails(
      this.details,
      line.branch === undefined ? pointDetails(this, line, row) : orbitDetails(this, line, row),
    );
    this.bringIntoView(this.x(line)[row]);
  }

  bringIntoView(x) {
    if (x < this.view.x[0] || x > this.view.x[1]) {
      const half = 0.5 * (this.view.x[1] - this.view.x[0]);
      this.view.show([x - half, x + half]);
    } else {
      this.redraw();
    }
  }

  /// Chooses what a list below the diagram names, and shows it.
  select(found) {
    const line =
      found.line ??
      this.lines.find(({ study, branch }) => study === found.special.study && branch === found.special.branch);
    if (line && !line.shown) this.toggles.get(line).click();
    this.choose(found);
    (innerWidth < 1280 ? this.details : this.figure).scrollIntoView({ block: 'nearest' });
  }

  /// The point of a shown line with the nearest abscissa; the chosen line comes before others that are as near.
  nearestAt(x) {
    let best = null;
    for (const line of this.lines.filter(({ shown }) => shown)) {
      const row = line.rows[nearestIndex(line.rows, this.x(line), x)];
      const apart = Math.abs(this.x(line)[row] - x);
      const preferred = apart === best?.apart && line === this.chosen?.line;
      if (!best || apart < best.apart || preferred) best = { line, row, apart };
    }
    return best;
  }

  /// To the next point of the same line, or to the next line at the same place.
  step(by, across) {
    const shown = this.lines.filter((line) => line.shown);
    if (shown.length === 0) return;
    const { line, row } = this.chosen ?? { line: shown[0], row: null };
    if (row === null)
      return this.choose({
        line,
        row: line.rows[nearestIndex(line.rows, this.x(line), 0.5 * (this.view.x[0] + this.view.x[1]))],
      });
    if (across) {
      const next = shown[(shown.indexOf(line) + by + shown.length) % shown.length];
      return this.choose({ line: next, row: next.rows[nearestIndex(next.rows, this.x(next), this.x(line)[row])] });
    }
    const at = line.rows.indexOf(row) + by;
    if (at >= 0 && at < line.rows.length) this.choose({ line, row: line.rows[at] });
  }

  key(event) {
    const chosen = this.chosen ? this.x(this.chosen.line)[this.chosen.row] : undefined;
    const actions = {
      ArrowRight: () => (event.shiftKey ? this.view.pan(0.2) : this.step(1)),
      ArrowLeft: () => (event.shiftKey ? this.view.pan(-0.2) : this.step(-1)),
      ArrowUp: () => this.step(-1, true),
      ArrowDown: () => this.step(1, true),
      '+': () => this.view.zoom(0.5, chosen),
      '=': () => this.view.zoom(0.5, chosen),
      '-': () => this.view.zoom(2, chosen),
      0: () => this.view.reset(),
    };
    if (!actions[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    actions[event.key]();
  }

  redraw() {
    for (const panel of this.view.panels) panel.redraw();
  }

  // ---- the page -------------------------------------------------------------------------------------------------

  build(host, memory) {
    this.view = new View(this.full());
    if (memory?.view) this.view.x = [...memory.view];
    this.details =
      memory?.details ??
      element(
        'section',
        { class: 'details', 'aria-label': 'The chosen point' },
        element('p', {
          class: 'hint',
          text: 'Choose a point of the diagram: click on it, or use the arrow keys in the diagram.',
        }),
      );
    const figure = element('div', {
      class: 'figure',
      tabIndex: 0,
      role: 'group',
      'aria-label': 'Diagram. Arrow keys choose a point, + and − zoom, 0 shows all.',
      onkeydown: (event) => this.key(event),
    });
    host.append(
      this.toolbar(),
      element(
        'div',
        { class: 'columns' },
        element('div', { class: 'main' }, figure, this.legend(), this.help(), changesTable(this), specialTable(this)),
        this.details,
      ),
    );
    this.figure = figure;
    const live = this.studies.find(({ kind }) => kind === 'sweep')?.live;
    const panel = (options) =>
      new Panel({
        host: figure,
        view: this.view,
        sync: `diagram${Diagram.count}`,
        xLabel: () => this.axis.label,
        pick: (found) => {
          this.choose(found);
          // In one column the panel of the point is below the diagram.
          if (innerWidth < 1280) this.details.scrollIntoView({ block: 'nearest' });
        },
        at: (x) => this.nearestAt(x),
        region: live && ((range) => live.refine(this.shownRange(range))),
        ...options,
      });
    Diagram.count = (Diagram.count ?? 0) + 1;
    const below = [
      ['lyapunov_max', 0, (x) => this.rangeBelow('lyapunov_max', x)],
      ['multiplier_max', 1, (x) => this.rangeBelow('multiplier_max', x, 4)],
    ].filter(([name]) => this.lines.some((line) => this.curve(line, name)?.some(Number.isFinite)));
    this.main = panel({
      height: () => (innerWidth < 700 ? 300 : 420),
      xAxis: below.length === 0,
      yLabel: () => `${this.bySection ? 'Poincaré points of ' : ''}${axisLabel(this.quantity)}`,
      range: (x) => this.range(x),
      draw: (context, place) => this.draw(context, place),
      hover: (place) =>
        this.hover(
          place,
          (line, row) => {
            const section = this.section(line);
            if (section)
              return Array.from(
                section.values.subarray(section.starts[row], section.starts[row + 1]),
                (y) => this.factor() * y,
              );
            const values = this.bySection ? null : this.curve(line);
            return values ? [this.factor() * values[row]] : [];
          },
          this.quantity,
        ),
    });
    if (memory?.y && memory.quantity === this.quantity.name) this.main.y = memory.y;
    below.forEach(([name, limit, range], k) => {
      const column = this.lines.map(({ table }) => table.byName.get(name)).find(Boolean);
      panel({
        height: () => (k + 1 === below.length ? 158 : 116),
        xAxis: k + 1 === below.length,
        yLabel: () => axisLabel(column),
        range,
        draw: (context, place) => this.drawBelow(context, place, name, limit),
        hover: (place) =>
          this.hover(place, (line, row) => (this.curve(line, name) ? [this.curve(line, name)[row]] : []), column),
      });
    });
  }

  toolbar() {
    const { sections, curves } = this.quantities;
    const value = (group, column) => `${group}:${column.name}`;
    const options = [
      ...sections.map((column) => ({ column, value: value('section', column), group: 'Poincaré points' })),
      ...curves.map((column) => ({ column, value: value('curve', column) })),
    ];
    const chooser = quantityChooser(
      options,
      this.quantity && value(this.bySection ? 'section' : 'curve', this.quantity),
      ({ column, group }) => {
        this.bySection = group === 'Poincaré points';
        this.quantity = column;
        this.main.relabel();
      },
      { id: 'quantity' },
    );
    const axes = element(
      'select',
      {
        onchange: () => {
          this.axis = this.axes[axes.selectedIndex];
          this.view.full = this.full();
          this.view.x = [...this.view.full];
          for (const panel of this.view.panels) panel.relabel();
        },
      },
      this.axes.map((axis) =>
        element('option', { text: axis.label.replace(/\s+/g, ' '), selected: axis === this.axis }),
      ),
    );
    const units = element(
      'select',
      {
        onchange: () => {
          lengthUnit.micrometres = units.selectedIndex === 1;
          for (const panel of this.view.panels) panel.relabel();
          if (this.chosen) this.choose(this.chosen);
        },
      },
      ['b_c', 'µm'].map((text, k) => element('option', { text, selected: lengthUnit.micrometres === (k === 1) })),
    );
    const colours = element(
      'select',
      {
        onchange: () => {
          this.colourBy = colours.selectedIndex === 0 ? 'regime' : 'line';
          this.key_.replaceWith(this.legend());
          this.redraw();
        },
      },
      ['regime', 'direction'].map((text, k) =>
        element('option', { text, selected: (this.colourBy === 'regime') === (k === 0) }),
      ),
    );
    const button = (text, label, action) =>
      element('button', { type: 'button', text, title: label, 'aria-label': label, onclick: action });
    const field = (text, control) => element('label', {}, element('span', { text }), control);
    const several = this.studies.length > 1;
    this.toggles = new Map();
    const toggles = this.lines.map((line) => {
      const box = element('input', {
        type: 'checkbox',
        checked: line.shown,
        onchange: () => {
          line.shown = box.checked;
          this.toggled.set(keyOf(line), line.shown);
          this.redraw();
        },
      });
      this.toggles.set(line, box);
      const swatch =
        line.branch === undefined ? null : element('span', { class: `swatch series${this.seriesOf(line)}` });
      return element(
        'label',
        { class: 'toggle' },
        box,
        swatch,
        several ? `${line.study.label}: ${line.name}` : line.name,
      );
    });
    return element(
      'div',
      { class: 'toolbar' },
      field('Ordinate', chooser.select),
      chooser.filter && field('Find a quantity', chooser.filter),
      this.axes.length > 1 ? field('Abscissa', axes) : null,
      field('Lengths in', units),
      this.lines.some(({ classes }) => classes) ? field('Colour by', colours) : null,
      element('span', { class: 'toggles', role: 'group', 'aria-label': 'Shown' }, toggles),
      element(
        'span',
        { class: 'buttons' },
        button('−', 'Zoom out', () => this.view.zoom(2)),
        button('+', 'Zoom in', () => this.view.zoom(0.5)),
        button('All', 'Show the whole range', () => this.view.reset()),
        button('‹', 'Previous point', () => this.step(-1)),
        button('›', 'Next point', () => this.step(1)),
      ),
    );
  }

  legend() {
    this.key_ = element('ul', { class: 'legend' });
    const item = (colour, text, extra = '') =>
      this.key_.append(element('li', {}, element('span', { class: `swatch ${colour} ${extra}` }), text));
    const swept = this.lines.filter(({ classes }) => classes);
    if (this.colourBy === 'regime')
      classNames.forEach((name, k) => {
        const count = swept.reduce(
          (sum, { rows, classes }) => sum + rows.filter((row) => classes[row] === k).length,
          0,
        );
        if (count > 0) item(`class${k}`, `${name}: ${count} ${count === 1 ? 'point' : 'points'}`);
      });
    else
      swept.forEach((line) =>
        item(`series${this.seriesOf(line)}`, this.studies.length > 1 ? `${line.study.label}: ${line.name}` : line.name),
      );
    const lost = swept.reduce((sum, { rows, classes }) => sum + rows.filter((row) => classes[row] === -1).length, 0);
    if (lost > 0) item('none', `not reached and not drawn: ${lost}`);
    if (this.lines.some(({ branch }) => branch !== undefined)) {
      item('solid', 'stable branch');
      item('dashed', 'unstable branch');
      for (const kind of new Set(this.special.map((point) => point.kind)))
        item('none', `${specialName(kind)[0]}: ${specialName(kind)[1]}`);
    }
    return this.key_;
  }

  help() {
    return element('p', {
      class: 'hint',
      text:
        'Drag to zoom; use the wheel with Ctrl to zoom, with Alt along the ordinate; drag with Shift to pan; double-click to show all. ' +
        'Keys in the diagram: ← → next point, ↑ ↓ other direction or branch, + − zoom, Shift ← → pan, 0 all.',
    });
  }
}

/// Rows next to a value, of rows in the order of their values.
function around(rows, xs, at) {
  const k = nearestIndex(rows, xs, at);
  return rows.slice(Math.max(0, k - 2), k + 3);
}

function nearestIndex(rows, xs, at) {
  let best = 0;
  for (let i = 1; i < rows.length; ++i) if (Math.abs(xs[rows[i]] - at) < Math.abs(xs[rows[best]] - at)) best = i;
  return best;
}
