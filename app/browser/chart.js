// A figure of any table: one column of numbers over another, in colours by a column of words.
import { Panel, View, dot, nearestRow, strokeLine } from './panel.js';
import { theme } from './theme.js';
import { axisLabel, element, factorOf, number, rich } from './words.js';
import { extent } from './details.js';
import { specialName } from './diagram.js';

/// Columns of tables that are best known over each other; of other tables the first two columns of numbers.
const usual = {
  'stiffness.csv': { x: 'phase', y: 'k_sp_N_per_m', joined: true },
  'load_sharing.csv': { x: 'position', y: 'share', group: 'mesh' },
  'friction.csv': { x: 'position', y: 'mu', group: 'mesh' },
  'friction_ratios.csv': { x: 'phase', y: 'force_ratio', group: 'mesh', joined: true },
  'bearings.csv': { x: 'approach_um', y: 'force_N', group: 'member' },
  'campbell.csv': { x: 'mesh_frequency_ratio', y: 'frequency_ratio', group: 'type', lines: 'harmonic' },
  'static_transmission_error.csv': { x: 'torque_Nm', y: 'peak_to_peak_um', group: 'mesh', joined: true },
  'modes.csv': { x: 'mode', y: 'frequency_Hz', group: 'type' },
  'loci.csv': { x: 'first', y: 'second', group: 'kind' },
  'orbits.csv': { x: 'value', y: 'multiplier_max' },
  'ramp.csv': { x: 'mesh_frequency_ratio', y: 'delta_sp_order_1', group: 'direction', joined: true },
  'tolerance.csv': { x: 'rhs_evaluations', y: 'flow_error', group: 'method', logarithmic: true },
  'crosscheck.csv': { x: 'value', y: 'orbit_distance', group: 'variant', logarithmic: true },
  'profile.csv': { x: 'value', y: 'cost', group: 'variable' },
};

/// Tables that are drawn without being opened.
export const hasUsualChart = (table) => table.name in usual && table.rows > 1;

/// @param labels  of columns, in place of their names
export function chartOf(table, caption, labels = {}) {
  const numeric = table.columns.filter(
    ({ name, form }) => form !== 'words' && table.numbers(name).some(Number.isFinite),
  );
  if (numeric.length < 2 || table.rows < 2) return null;
  const words = table.columns.filter(({ form, words: all }) => form === 'words' && all.length > 1 && all.length <= 20);
  const choice = usual[table.name] ?? {};
  const find = (name, otherwise) => numeric.find((column) => column.name === name) ?? numeric[otherwise];
  let [x, y] = [find(choice.x, 0), find(choice.y, 1)];
  let group = words.find(({ name }) => name === choice.group);
  let logarithmic = Boolean(choice.logarithmic);
  const values = ({ name, unit }) => Float64Array.from(table.numbers(name), (value) => factorOf(unit) * value);
  let [xs, ys] = [values(x), values(y)];
  const groupOf = (row) => (group ? table.numbers(group.name)[row] : 0);
  const host = element('figure', { class: 'small' });
  const view = new View(extent(xs));
  const legend = element('ul', { class: 'legend' });
  const panel = new Panel({
    host,
    view,
    height: () => 300,
    xLabel: () => labels[x.name] ?? axisLabel(x),
    yLabel: () => labels[y.name] ?? axisLabel(y),
    logarithmic: () => logarithmic,
    range: () => {
      if (!logarithmic) return extent(ys);
      const positive = ys.filter((value) => value > 0);
      const [low, high] = positive.reduce(([a, b], value) => [Math.min(a, value), Math.max(b, value)], [Infinity, 0]);
      return low <= high ? [low / 1.5, high * 1.5] : [0.1, 1];
    },
    draw: (context, place) => {
      const rows = Array.from({ length: table.rows }, (_, row) => row);
      if (choice.joined && x.name === choice.x) {
        for (const of of new Set(rows.map(groupOf))) {
          const own = rows.filter((row) => groupOf(row) === of);
          const [ownX, ownY] = [xs, ys].map((all) => own.map((row) => all[row]));
          strokeLine(context, place, ownX, ownY, { colour: theme().series[of % 10] });
        }
        return;
      }
      // A line from the origin through each of its points, for each harmonic of the mesh frequency.
      if (choice.lines && x.name === choice.x && y.name === choice.y)
        for (const slope of new Set(table.numbers(choice.lines))) {
          const end = place.xRange[1];
          strokeLine(context, place, [0, end], [0, slope * end], { colour: theme().faint });
        }
      for (const row of rows)
        if (Number.isFinite(xs[row]) && Number.isFinite(ys[row]) && !(logarithmic && !(ys[row] > 0)))
          dot(context, place.x(xs[row]), place.y(ys[row]), 2.4 * place.ratio, theme().series[groupOf(row) % 10]);
    },
    hover: (place) => {
      const nearest = nearestRow(place, xs, ys);
      if (nearest === null) return null;
      const lines = [x, y].map(({ name }, k) => `${name} = ${number([xs, ys][k][nearest])}`);
      const named = words.map(({ name }) => table.word(name, nearest)).filter(Boolean);
      return { text: [...lines, ...(named.length > 0 ? [named.join(', ')] : [])].join('\n') };
    },
  });
  const refresh = () => {
    [xs, ys] = [values(x), values(y)];
    view.full = extent(xs);
    view.x = [...view.full];
    panel.relabel();
    legend.replaceChildren(
      ...(group ? group.words : []).map((word, k) =>
        element(
          'li',
          {},
          element('span', { class: `swatch series${k % 10}` }),
          (group.name === 'kind' && specialName(word)[1]) || word || 'none',
        ),
      ),
    );
  };
  const select = (text, columns, current, action) => {
    const made = element(
      'select',
      { onchange: () => (action(columns[made.selectedIndex]), refresh()) },
      columns.map((column) =>
        element('option', { text: column ? column.name : 'nothing', selected: column === current }),
      ),
    );
    return element('label', {}, element('span', { text }), made);
  };
  const box = element('input', {
    type: 'checkbox',
    checked: logarithmic,
    onchange: () => ((logarithmic = box.checked), refresh()),
  });
  host.append(
    element('figcaption', {}, rich(caption)),
    legend,
    element(
      'div',
      { class: 'choosers' },
      select('Abscissa', numeric, x, (column) => (x = column)),
      select('Ordinate', numeric, y, (column) => (y = column)),
      words.length > 0 ? select('Colour by', [undefined, ...words], group, (column) => (group = column)) : null,
      element('label', { class: 'toggle' }, box, 'logarithmic ordinate'),
    ),
  );
  refresh();
  return host;
}
