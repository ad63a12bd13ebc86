// Numbers, units and names of columns as people read them.

export const lengthUnit = { micrometres: false, um_per_b_c: 10 };

/// "0.0123 ± 0.0004": two digits of the error, and the value down to the last of them.
export function withError(value, error) {
  if (!Number.isFinite(value)) return 'not known';
  if (!(error > 0) || !Number.isFinite(error)) return number(value, 7);
  const digits = 1 - Math.floor(Math.log10(error));
  const size = Math.abs(value);
  if (digits > 12 || size >= 1e6 || (size > 0 && size < 1e-4 && error < 1e-4)) {
    const shown = Math.min(15, Math.max(1, digits + Math.floor(Math.log10(Math.max(size, error))) + 1));
    return `${number(value, shown)} ± ${number(error, 2)}`;
  }
  const decimals = Math.min(12, Math.max(0, digits));
  return `${minus(value.toFixed(decimals))} ± ${error.toFixed(decimals)}`;
}

const minus = (text) => text.replace('-', '−');

/// A number to so many significant digits.
export function number(value, digits = 6) {
  if (value === null || value === undefined || Number.isNaN(value)) return '';
  if (!Number.isFinite(value)) return value > 0 ? 'infinite' : '−infinite';
  if (Number.isInteger(value) && Math.abs(value) < 1e9) return minus(String(value));
  const size = Math.abs(value);
  if (size >= 1e-4 && size < 1e7) return minus(String(Number(value.toPrecision(digits))));
  const [mantissa, exponent] = value.toExponential(Math.max(0, digits - 1)).split('e');
  const tidy = mantissa.includes('.') ? mantissa.replace(/0+$/, '').replace(/\.$/, '') : mantissa;
  return `${minus(tidy)}·10${superscript(Number(exponent))}`;
}

export function superscript(value) {
  const digits = '⁰¹²³⁴⁵⁶⁷⁸⁹';
  return [...String(value)].map((c) => (c === '-' ? '⁻' : digits[Number(c)])).join('');
}

/// What values of a unit are multiplied by to be shown.
export function factorOf(unit) {
  return lengthUnit.micrometres && unit === 'b_c' ? lengthUnit.um_per_b_c : 1;
}

export function unitText(unit) {
  if (!unit || unit === '1' || unit.startsWith('of the ')) return '';
  if (unit === 'b_c') return lengthUnit.micrometres ? 'µm' : 'b_c';
  return unit
    .replace(/\bum\b/g, 'µm')
    .replace(/^1 per tau/, 'per τ')
    .replace(/per tau/g, 'per τ');
}

const letters = { delta: 'δ', force: 'F', load_sharing: 'L', kv: 'K_v', k_gamma: 'K_γ', dynamic_factor: 'K' };
const statistics = {
  mean: 'Mean of',
  rms: 'RMS of',
  range: 'Peak to peak of',
  min: 'Least',
  max: 'Largest',
  h1: 'Harmonic 1 of',
  h2: 'Harmonic 2 of',
  h3: 'Harmonic 3 of',
};

/// "δ_sp,1" of delta_sp_1, "dδ_sp,1/dτ" of its rate, "RMS of δ_sp,1" of delta_sp_rms; empty without a symbol.
export function symbol(name) {
  const known = { lyapunov_max: 'λ₁', multiplier_max: '|μ|max', period: 'Period n' };
  if (known[name]) return known[name];
  const end = name.slice(name.lastIndexOf('_') + 1);
  if (statistics[end]) {
    const begin = name.slice(0, -end.length - 1);
    const of = begin === 'transmission_error' ? 'transmission error' : symbol(begin);
    return of && `${statistics[end]} ${of}`;
  }
  if (end === 'rate') {
    const of = symbol(name.slice(0, -end.length - 1));
    return of && `d${of}/dτ`;
  }
  const found = /^(delta|force|load_sharing|kv|k_gamma|dynamic_factor)_(sp|rp)(?:_(\d+))?$/.exec(name);
  if (!found) return '';
  // Without a number: of planet 1, or of all planets.
  const planet = found[3] ?? (['delta', 'force', 'load_sharing'].includes(found[1]) ? '1' : '');
  const letter = letters[found[1]];
  return `${letter}${letter.includes('_') ? ',' : '_'}${found[2]}${planet && `,${planet}`}`;
}

const unitsOfNames = {
  N_per_m: 'N/m',
  m_per_s: 'm/s',
  um: 'µm',
  mm: 'mm',
  m: 'm',
  N: 'N',
  Nm: 'N m',
  Hz: 'Hz',
  rpm: 'rpm',
  s: 's',
  GPa: 'GPa',
  rad: 'rad',
  deg: '°',
};

const wordsOfNames = {
  mu: 'Friction coefficient µ',
  rhs_evaluations: 'Evaluations of the right-hand side',
  k_sp_N_per_m: 'Mesh stiffness k_sp',
  k_rp_N_per_m: 'Mesh stiffness k_rp',
};

/// "Approach [µm]" of approach_um: the name of a column without a meaning, which may end in its unit.
function spokenName(name) {
  const unit = Object.keys(unitsOfNames).find((end) => name.endsWith(`_${end}`));
  const words = wordsOfNames[name];
  const begin = unit ? name.slice(0, -unit.length - 1) : name;
  return `${words ?? capital(begin.replace(/_/g, ' '))}${unit ? `  [${unitsOfNames[unit]}]` : ''}`;
}

/// The label of an axis: "RMS of δ_sp,1 [µm]".
export function axisLabel(column) {
  const unit = unitText(column.unit);
  const known = symbol(column.name) || capital(column.meaning ?? '');
  if (!known) return unit ? `${column.name}  [${unit}]` : spokenName(column.name);
  const words = known.length > 44 ? column.name : known;
  return unit ? `${words}  [${unit}]` : words;
}

export const capital = (text) => (text ? text[0].toUpperCase() + text.slice(1) : text);

/// An element with text and children; nothing of a text is ever read as HTML.
export function element(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === undefined || value === null) continue;
    if (name === 'class') made.className = value;
    else if (name === 'text') made.textContent = value;
    else if (name.startsWith('on')) made.addEventListener(name.slice(2), value);
    else if (name in made && typeof value !== 'string') made[name] = value;
    else made.setAttribute(name, value);
  }
  for (const child of children.flat()) if (child !== null && child !== undefined) made.append(child);
  return made;
}

/// A text with each name_index as a subscript, as in "δ_sp,1" or "λ_1".
export function rich(text) {
  const made = element('span');
  let end = 0;
  for (const found of text.matchAll(/(?<=[A-Za-zδλμΩωζ])_([A-Za-z0-9γ]+(?:,[A-Za-z0-9]+)*)/gu)) {
    if (
      !/^(b|K|L|F|δ|λ|μ|ω|Ω|n|f)$/u.test(
        text
          .slice(0, found.index)
          .split(/[^\p{L}]/u)
          .pop(),
      )
    )
      continue;
    made.append(text.slice(end, found.index), element('sub', { text: found[1] }));
    end = found.index + found[0].length;
  }
  made.append(text.slice(end));
  return made;
}

/// A table of rows of cells; the first cell of a row is its head. Cells are texts or elements.
export function tableOf(head, rows, caption) {
  const cell = (tag, value, extra = {}) => {
    const made = element(tag, extra);
    made.append(value instanceof Node ? value : rich(String(value)));
    return made;
  };
  return element(
    'table',
    {},
    caption ? element('caption', { text: caption }) : null,
    head
      ? element(
          'thead',
          {},
          element(
            'tr',
            {},
            head.map((value) => cell('th', value, { scope: 'col' })),
          ),
        )
      : null,
    element(
      'tbody',
      {},
      rows.map((row) =>
        element(
          'tr',
          {},
          row.map((value, k) => (k === 0 ? cell('th', value, { scope: 'row' }) : cell('td', value))),
        ),
      ),
    ),
  );
}
