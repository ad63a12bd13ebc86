// A list of many quantities to choose from: grouped by what they are, the most used first, with a filter.
import { element, symbol } from './words.js';

const mostUsed = [
  'delta_sp_rms',
  'delta_sp_range',
  'delta_rp_rms',
  'kv_sp',
  'kv_rp',
  'dynamic_factor_sp',
  'force_sp_max',
  'force_bearing_max',
  'transmission_error_range',
  'loss_time_sp',
  'lyapunov_max',
  'multiplier_max',
  'period',
];

/// The first that a name matches is its group; a planet's own quantities are apart from those of planet 1 or of all.
const groups = [
  ['Deflections', /^(delta|planet_spread|static_deflection)/],
  ['Transmission error', /^transmission_error/],
  ['Dynamic, load and sharing factors', /^(kv|k_gamma|dynamic_factor|load_sharing)(_|$)/],
  ['Forces', /force/],
  ['Contact and tension, parts of the time', /(_time|^contact|touch)(_|$)/],
  [
    'Regime and its evidence',
    /^(period|lyapunov|multiplier|stable|unstable|zero_one|orbit|recurrence|converged|settled|residual|attractor|evidence)/,
  ],
  ['Speeds and frequencies', /(_rpm|_Hz|_frequency)$/],
  ['Counts', /(evaluations|periods|steps|count)/],
  ['Others', /^/],
];

function groupOf(name) {
  const ofPlanet = /_(?:(?:sp|rp)_(\d+)|bearing_(\d+))(?:_|$)/.exec(name);
  const [title] = groups.find(([, pattern]) => pattern.test(name));
  return ofPlanet ? `${title}, each planet` : title;
}

const order = [
  'Poincaré points',
  'Regimes and attractors',
  'Most used',
  ...groups.flatMap(([title]) => [title, `${title}, each planet`]),
];

function optionText({ name, meaning }) {
  const short = symbol(name);
  const words = meaning || (short ? '' : 'no description');
  return `${name}${short ? ` (${short})` : ''}${words && ` – ${words}`}`.slice(0, 110);
}

/// Words in small letters, each behind a blank; names of columns are several.
const wordsOfText = (text) =>
  text
    .toLowerCase()
    .replace(/[^\p{L}\p{N}]+/gu, ' ')
    .trim();
const matches = ({ text, group }, words) =>
  words.every((word) => ` ${wordsOfText(`${text} ${group}`)}`.includes(` ${word}`));
const few = 12; // options that need no filter

/// @param options  column, value and, if it is not found by the name, group
/// @param chosen   the value of one of them
/// @param action   called with an option when it is chosen
/// @returns select, and filter: an input, or null for few options
export function quantityChooser(options, chosen, action, properties = {}) {
  const all = options.map((option) => ({
    ...option,
    group: option.group ?? (mostUsed.includes(option.column.name) ? 'Most used' : groupOf(option.column.name)),
    text: optionText(option.column),
  }));
  const place = ({ group, column }) =>
    1000 * order.indexOf(group) + (group === 'Most used' ? mostUsed.indexOf(column.name) : 0);
  all.sort((a, b) => place(a) - place(b));
  const select = element('select', {
    ...properties,
    onchange: () => action(all.find(({ value }) => value === select.value)),
  });
  const fill = (words) => {
    const current = select.value || chosen;
    const wanted = all.filter((option) => option.value === current || matches(option, words));
    select.replaceChildren(
      ...[...new Set(wanted.map(({ group }) => group))].map((label) =>
        element(
          'optgroup',
          { label },
          wanted.filter(({ group }) => group === label).map(({ value, text }) => element('option', { value, text })),
        ),
      ),
    );
    if (current) select.value = current;
    return all.filter((option) => matches(option, words));
  };
  fill([]);
  if (all.length <= few) return { select, filter: null };
  const said = element('span', { role: 'status', class: 'unseen' });
  const input = element('input', {
    type: 'search',
    placeholder: 'name or meaning',
    oninput: () => {
      const found = fill(wordsOfText(input.value).split(' ').filter(Boolean));
      said.textContent = `${found.length} of ${all.length} quantities`;
    },
    onkeydown: (event) => {
      if (event.key !== 'Enter') return;
      event.preventDefault();
      const [first] = fill(wordsOfText(input.value).split(' ').filter(Boolean));
      if (!first) return;
      select.value = first.value;
      action(first);
    },
  });
  return { select, filter: element('span', { class: 'filter' }, input, said) };
}
