// Changes of the regime along a sweep and special points of branches, as tables whose rows select a point of the diagram.
import { element, number, rich, tableOf, withError } from './words.js';
import { specialName } from './diagram.js';

/// Neighbouring values of one direction whose regimes or periods differ, in the order in which the sweep reaches them.
/// Points that were not reached count for none.
function changesOf(line) {
  const { table } = line;
  const rows = line.rows.filter((row) => line.classes[row] !== -1);
  if (line.direction === 'down') rows.reverse();
  const period = table.numbers('period');
  const key = (row) => `${table.word('regime', row)} ${period[row]}`;
  return rows
    .slice(1)
    .map((row, k) => ({ line, before: rows[k], behind: row }))
    .filter(({ before, behind }) => key(before) !== key(behind));
}

/// What the report has of the orbit beside each change, by the numbers of its two points.
function multipliersOf(study) {
  const table = study.table('change_multipliers');
  const known = new Map();
  for (let row = 0; row < (table?.rows ?? 0); ++row) {
    const get = (name) => table.numbers(name)[row];
    known.set([get('point'), get('other')].sort((a, b) => a - b).join(), {
      point: get('point'),
      found: get('found') === 1,
      unstable: get('unstable'),
      oneKind: get('one_kind') === 1,
      here: [get('here_real'), get('here_imaginary')],
      there: [get('there_real'), get('there_imaginary')],
      thereAt: get('there_value'),
      fold: get('fold') === 1,
    });
  }
  return known;
}

const isReal = ([re, im]) => Math.abs(im) <= 1e-6 * Math.hypot(re, im);

function multiplierText(multiplier) {
  const [re, im] = multiplier;
  if (isReal(multiplier)) return number(re, 4);
  return `${number(re, 4)} ± ${number(Math.abs(im), 4)} i (modulus ${number(Math.hypot(re, im), 4)})`;
}

/// The kind of a change: by special points of branches between its values, or by the multipliers that leave the unit
/// circle.
function typeOf(change, diagram, known) {
  const values = change.line.table.numbers('value');
  const [low, high] = [values[change.before], values[change.behind]].sort((a, b) => a - b);
  const period = change.line.table.numbers('period');
  const periods = [period[change.before], period[change.behind]].filter((n) => n > 0);
  const between = diagram.special.filter(({ study, row, value, kind }) => {
    const special = study.table('special.csv');
    const error = special.numbers('error_bound')[row] || 0;
    return (
      kind !== 'grazing' &&
      value >= low - error &&
      value <= high + error &&
      periods.includes(special.numbers('period')[row])
    );
  });
  if (between.length > 0)
    return between.map(({ kind, branch }) => `${specialName(kind)[1]}, branch ${branch}`).join('; ');
  if (!known) return 'not known: the orbit is too long for this page, or Newton’s method does not find it';
  if (known.fold) return 'fold (jump)';
  if (!known.found) {
    const end = number(known.thereAt, 6);
    return `not known: the orbit is lost near ${end} without a multiplier that nears +1, as at a grazing of a contact`;
  }
  if (known.unstable === 0) return 'none: the orbit stays stable';
  if (!known.oneKind) return 'several multipliers';
  if (!isReal(known.there)) return 'Neimark-Sacker (torus)';
  return known.there[0] < 0 ? 'period doubling (flip)' : 'fold or branch point';
}

const link = (text, label, action) =>
  element('button', { type: 'button', class: 'link', 'aria-label': label, onclick: action }, rich(text));

/// @returns a `details` element of a diagram with a sweep, or null
export function changesTable(diagram) {
  const all = diagram.lines.filter(({ classes }) => classes).flatMap(changesOf);
  const swept = diagram.lines.filter(({ classes }) => classes);
  if (swept.length === 0) return null;
  const several = new Set(swept.map(({ study }) => study)).size > 1;
  const multipliers = new Map(swept.map(({ study }) => [study, multipliersOf(study)]));
  const { symbol } = diagram.parameter;
  const regime = ({ table }, row) => {
    const word = table.word('regime', row);
    return word === 'periodic' ? `period ${table.numbers('period')[row]}` : word;
  };
  const rowOf = (change) => {
    const { line, before, behind } = change;
    const value = line.table.numbers('value');
    const point = line.table.numbers('point');
    const known = multipliers.get(line.study).get([point[before], point[behind]].sort((a, b) => a - b).join());
    const bracket = `${number(value[before], 8)} to ${number(value[behind], 8)}`;
    const isThere = known && (known.fold || !known.found || known.unstable > 0);
    const own = known && [before, behind].find((row) => point[row] === known.point);
    return [
      link(bracket, `Select the point before the change of ${symbol} from ${bracket}`, () =>
        diagram.select({ line, row: before }),
      ),
      several ? `${line.study.label}: ${line.name}` : line.name,
      regime(line, before),
      regime(line, behind),
      isBeside(change) ? typeOf(change, diagram, known) : '',
      known
        ? `${multiplierText(isThere ? known.there : known.here)} at ${number(isThere ? known.thereAt : value[own], 8)}`
        : '',
    ];
  };
  const isBeside = ({ line, before, behind }) =>
    [before, behind].some((row) => line.table.word('regime', row) === 'periodic');
  const place = element('div', {
    class: 'scroll tall',
    tabIndex: 0,
    role: 'region',
    'aria-label': 'Changes of the regime',
  });
  const fill = (changes) =>
    place.replaceChildren(
      tableOf([`${symbol} between`, 'Direction', 'From', 'To', 'Type', 'Multiplier μ'], changes.map(rowOf)),
    );
  const beside = all.filter(isBeside);
  const many = 20; // the changes between other regimes are then behind a click
  const box = element('input', {
    type: 'checkbox',
    checked: all.length > many && beside.length > 0,
    onchange: () => fill(box.checked ? beside : all),
  });
  const made = element(
    'details',
    { class: 'list', open: true },
    element('summary', { text: `Changes of the regime: ${all.length}` }),
  );
  if (all.length === 0) {
    made.append(element('p', { class: 'hint', text: 'Regime and period are the same at all values.' }));
    return made;
  }
  fill(box.checked ? beside : all);
  made.append(
    beside.length > 0 && beside.length < all.length
      ? element('label', { class: 'toggle' }, box, ` Only beside a periodic orbit: ${beside.length}`)
      : '',
    place,
    element(
      'p',
      { class: 'hint' },
      rich(
        'The values are in the order of the sweep. A periodic orbit beside the change is followed from its value to the other one. ' +
          'Type: the multiplier μ that leaves the unit circle. If none leaves it, the largest μ of the stable orbit is shown. ' +
          'Fold (jump): the orbit ends between the values, and its largest μ nears +1 there.',
      ),
    ),
  );
  return made;
}

/// @returns a `details` element of a diagram with special points of branches, or null
export function specialTable(diagram) {
  if (diagram.special.length === 0) return null;
  const rows = [...diagram.special]
    .sort((a, b) => a.value - b.value)
    .map((point) => {
      const table = point.study.table('special.csv');
      const word = (name) => (table.has(name) ? table.word(name, point.row) : '');
      const text = withError(point.value, table.numbers('error_bound')[point.row]);
      const [short, words] = specialName(point.kind);
      const multipliers = word('multipliers')
        .split(/\s+/)
        .filter(Boolean)
        .map((one) => {
          const found = /^(.*\d)([+-][^+-]*(?:e[+-]?\d+)?)i$/.exec(one);
          return found ? multiplierText([Number(found[1]), Number(found[2])]) : one;
        });
      return [
        link(text, `Select ${words} at ${text}`, () => diagram.select({ special: point })),
        `${short}: ${words}`,
        String(point.branch),
        String(table.numbers('period')[point.row]),
        [...new Set(multipliers)].join('; '),
        [word('broken_symmetry'), word('contact')].filter(Boolean).join('; '),
      ];
    });
  return element(
    'details',
    { class: 'list', open: true },
    element('summary', { text: `Special points of the branches: ${rows.length}` }),
    element(
      'div',
      { class: 'scroll tall special', tabIndex: 0, role: 'region', 'aria-label': 'Special points' },
      tableOf(
        [diagram.parameter.symbol, 'Type', 'Branch', 'Period', 'Multipliers on the unit circle', 'Symmetry, contact'],
        rows,
      ),
    ),
  );
}
