// What is known of one point of a sweep, of one orbit of a branch, or of a special point.
import { Panel, View, dot, nearestRow, rangeOf, releasePanels, strokeLine } from './panel.js';
import { theme } from './theme.js';
import { axisLabel, capital, element, factorOf, number, rich, symbol, tableOf, unitText, withError } from './words.js';
import { errorOf, specialName } from './diagram.js';

/// One value with its error and unit.
export function valueText(table, name, row) {
  const column = table.byName.get(name);
  if (column.form === 'words') return table.word(name, row);
  const value = table.numbers(name)[row];
  if (Number.isNaN(value)) return '';
  const error = errorOf(table, name);
  const factor = factorOf(column.unit);
  const text = error ? withError(factor * value, factor * table.numbers(error)[row]) : number(factor * value, 7);
  const unit = unitText(column.unit);
  return unit ? `${text} ${unit}` : text;
}

const meshOf = /^(.*?)_(sp|rp)_(\d+)(_.*)?$/;

/// Columns of each mesh as a table for each kind of mesh: a row for each quantity, a column for each planet.
function meshTables(table, row) {
  const tables = [
    ['sp', 'Meshes of the sun with planets 1, 2, ...'],
    ['rp', 'Meshes of the ring with planets 1, 2, ...'],
  ].map(([kind, title]) => {
    const planets = new Set();
    const quantities = new Map();
    for (const column of table.columns) {
      const found = meshOf.exec(column.name);
      if (!found || found[2] !== kind) continue;
      planets.add(found[3]);
      const key = `${found[1]}${found[4] ?? ''}`;
      if (!quantities.has(key)) quantities.set(key, { column, cells: new Map() });
      quantities.get(key).cells.set(found[3], column.name);
    }
    if (planets.size === 0) return null;
    const rows = [...quantities].map(([key, { column, cells }]) => {
      const unit = column.unit.startsWith('part of') ? '' : unitText(column.unit);
      const head = element('span', { title: generic(column.meaning) }, wordsOf(key), unit ? ` [${unit}]` : '');
      return [
        head,
        ...[...planets].map((planet) => {
          const name = cells.get(planet);
          if (!name) return '';
          return table.isNumeric(name)
            ? number(factorOf(column.unit) * table.numbers(name)[row], 5)
            : table.word(name, row).replace(/\+/g, ', ');
        }),
      ];
    });
    return element(
      'div',
      {},
      element('h4', { text: title }),
      element(
        'div',
        { class: 'scroll' },
        tableOf(
          ['', ...planets].map((planet) => (planet ? `${kind} ${planet}` : '')),
          rows,
        ),
      ),
    );
  });
  return tables.some(Boolean) ? element('div', {}, tables) : null;
}

/// "delta_min" in words.
function wordsOf(key) {
  const known = new Map(
    Object.entries({
      contact: 'contact',
      delta_min: 'least deflection',
      delta_max: 'largest deflection',
      delta_mean: 'mean deflection',
      delta_rms: 'RMS deflection',
      force_mean: 'mean force',
      force_rms: 'RMS force',
      force_max: 'largest force',
      load_sharing: 'load sharing (mean)',
      load_sharing_max: 'load sharing (largest)',
      force_quasi_static_max: 'largest quasi-static force',
      kv: 'dynamic factor K_v',
      drive_time: 'part of the time on the drive flank',
      loss_time: 'part of the time out of contact',
      back_time: 'part of the time on the back flank',
    }),
  );
  return known.get(key) ?? key.replace(/_/g, ' ');
}
const generic = (meaning) => (meaning ?? '').replace(/ mesh \d+\b/g, ' mesh');

/// All other columns, each with its meaning.
export function allValues(table, row) {
  const rows = table.columns
    .filter(({ name }) => !meshOf.test(name) && !/_error$/.test(name))
    .map((column) => [
      element('span', { title: column.name }, column.name),
      valueText(table, column.name, row),
      column.meaning,
    ])
    .filter(([, text]) => text !== '');
  return tableOf(['Quantity', 'Value', 'Meaning'], rows);
}

/// The same, made when it is opened: a point has more than a hundred columns.
function closedValues(summary, table, row) {
  const place = element('div', { class: 'scroll' });
  const fill = () => place.replaceChildren(allValues(table, row));
  const made = element('details', {}, element('summary', { text: summary }), place);
  made.addEventListener('toggle', fill, { once: true });
  return made;
}

/// A panel of its own, in a figure with a caption.
export function smallFigure(caption, options) {
  const host = element('figure', { class: 'small' });
  const view = new View(options.xRange());
  const panel = new Panel({ host, view, height: () => (innerHeight < 900 ? 190 : 240), ...options });
  host.append(element('figcaption', {}, rich(caption)));
  return { host, panel, view };
}

export function extent(values, margin = 0.05) {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) if (Number.isFinite(value)) [low, high] = [Math.min(low, value), Math.max(high, value)];
  return rangeOf(low, high, margin);
}

/// Two quantities of the section over each other, each to be chosen.
export function sectionFigure(section, first, last, colour) {
  const columns = section.columns;
  if (columns.length < 2 || last <= first) return null;
  const find = (name, otherwise) => columns.find((column) => column.name === name) ?? columns[otherwise];
  let [xc, yc] = [
    find('delta_sp_1', 0),
    columns.find(({ name }) => name === 'delta_sp_1_rate') ?? find('delta_rp_1', 1),
  ];
  const values = (column) =>
    Array.from(section.numbers(column.name).subarray(first, last), (value) => factorOf(column.unit) * value);
  const figure = smallFigure(
    `Poincaré section, one point each mesh period: ${last - first} ${last - first === 1 ? 'point' : 'points'}.`,
    {
      xLabel: () => axisLabel(xc),
      yLabel: () => axisLabel(yc),
      xRange: () => padded(extent(values(xc))),
      range: () => padded(extent(values(yc))),
      draw: (context, place) => {
        const [xs, ys] = [values(xc), values(yc)];
        const radius = (xs.length > 400 ? 1.4 : xs.length > 12 ? 2.2 : 3.5) * place.ratio;
        for (let i = 0; i < xs.length; ++i) dot(context, place.x(xs[i]), place.y(ys[i]), radius, colour());
      },
      hover: (place) => {
        const [xs, ys] = [values(xc), values(yc)];
        const row = nearestRow(place, xs, ys);
        if (row === null) return null;
        return { text: [xc, yc].map(({ name }, k) => `${name} = ${number([xs, ys][k][row])}`).join('\n') };
      },
    },
  );
  const chooser = (label, current, action) => {
    const made = element(
      'select',
      {
        'aria-label': label,
        onchange: () => {
          action(columns[made.selectedIndex]);
          figure.view.full = padded(extent(values(xc)));
          figure.view.x = [...figure.view.full];
          figure.panel.relabel();
        },
      },
      columns.map((column) => element('option', { text: column.name, selected: column === current })),
    );
    return made;
  };
  figure.host.append(
    element(
      'div',
      { class: 'choosers' },
      chooser('Abscissa of the section', xc, (column) => (xc = column)),
      ' and ',
      chooser('Ordinate of the section', yc, (column) => (yc = column)),
    ),
  );
  return figure.host;
}

/// All points of a periodic orbit may be one: then a range around it.
const padded = ([low, high]) => {
  const wide = Math.max(high - low, 1e-3 * Math.max(Math.abs(low), Math.abs(high)), 1e-12);
  const middle = 0.5 * (low + high);
  return [middle - 0.55 * wide, middle + 0.55 * wide];
};

function spectrumFigure(study, row, colour) {
  const { spectrum } = study;
  const table = study.table('spectra');
  if (!spectrum || !table) return null;
  const logs = table.numbers('log10_amplitude').subarray(row * spectrum.orders, (row + 1) * spectrum.orders);
  if (!logs.some(Number.isFinite)) return null;
  const xs = Array.from(logs, (_, k) => k * spectrum.resolution);
  const unit = { unit: 'b_c' };
  const ys = () => Array.from(logs, (value) => factorOf(unit.unit) * 10 ** value);
  const figure = smallFigure(
    `Amplitude spectrum of δ_sp,1: root mean square over stretches of ${spectrum.periods} mesh periods. A line between two of these frequencies appears up to 15 % too small.`,
    {
      xLabel: () => 'Frequency over the mesh frequency',
      yLabel: () => `Amplitude  [${unitText('b_c')}]`,
      logarithmic: () => true,
      xRange: () => [0, xs[xs.length - 1]],
      range: () => {
        const all = ys().filter((y) => y > 0);
        const high = Math.max(...all);
        return [Math.max(Math.min(...all), 1e-9 * high), 2 * high];
      },
      draw: (context, place) =>
        strokeLine(
          context,
          place,
          xs,
          ys().map((y) => (y > 0 ? y : NaN)),
          { colour: colour(), width: 1.2 },
        ),
      hover: (place) => {
        const all = ys();
        const row = nearestRow(place, xs, all);
        if (row === null) return null;
        return { text: `frequency ${number(xs[row], 4)} ω_m\namplitude ${number(all[row], 4)} ${unitText('b_c')}` };
      },
    },
  );
  return figure.host;
}

const historyColumns = [
  ['delta_sp_1', 'b_c', 'deflection of sun-planet mesh 1'],
  ['delta_rp_1', 'b_c', 'deflection of ring-planet mesh 1'],
  ['delta_sp_1_rate', 'b_c per tau', 'rate of the deflection of sun-planet mesh 1'],
  ['delta_rp_1_rate', 'b_c per tau', 'rate of the deflection of ring-planet mesh 1'],
  ['force_sp_1', 'N', 'force of sun-planet mesh 1'],
  ['force_rp_1', 'N', 'force of ring-planet mesh 1'],
].map(([name, unit, meaning]) => ({ name, unit, meaning }));

/// Some mesh periods that the page has of a point; null without them.
function storedHistory(study, row) {
  const { history } = study;
  const table = study.table('histories');
  const rows = history ? history.periods * history.phases + 1 : 0;
  if (!table || (row + 1) * rows > table.rows) return null;
  const numbers = (name) => table.numbers(name).subarray(row * rows, (row + 1) * rows);
  if (!numbers(table.columns[0].name).some(Number.isFinite)) return null;
  return { ...history, columns: table.columns, numbers };
}

/// A quantity over the time, and a deflection over its rate.
function historyFigures(history, colour) {
  const rows = history.periods * history.phases + 1;
  const values = ({ name, unit }) => Float64Array.from(history.numbers(name), (value) => factorOf(unit) * value);
  const times = Float64Array.from({ length: rows }, (_, k) => k / history.phases);
  const chooser = (columns, text, action) => {
    const made = element(
      'select',
      { 'aria-label': text, onchange: () => action(columns[made.selectedIndex]) },
      columns.map(({ name, meaning }) => element('option', { text: `${name} – ${meaning}` })),
    );
    return element('div', { class: 'choosers' }, made);
  };
  const has = (name) => history.columns.find((column) => column.name === name);
  const plain = history.columns.filter(({ name }) => !name.endsWith('_rate'));
  let shown = plain[0];
  const over = smallFigure(
    `Time history of ${history.periods} mesh periods, computed from the stored state for this page.`,
    {
      xLabel: () => 'Mesh periods',
      yLabel: () => axisLabel(shown),
      xRange: () => [0, history.periods],
      range: () => extent(values(shown)),
      draw: (context, place) => strokeLine(context, place, times, values(shown), { colour: colour() }),
    },
  );
  over.host.append(chooser(plain, 'Quantity of the history', (column) => ((shown = column), over.panel.relabel())));
  const pairs = history.columns.filter(({ name }) => has(`${name}_rate`));
  let pair = pairs[0];
  const rate = () => has(`${pair.name}_rate`);
  const portrait = smallFigure('Phase portrait of the same mesh periods; the dots are at the mesh phase 0.', {
    xLabel: () => axisLabel(pair),
    yLabel: () => axisLabel(rate()),
    xRange: () => extent(values(pair)),
    range: () => extent(values(rate())),
    draw: (context, place) => {
      const [xs, ys] = [values(pair), values(rate())];
      strokeLine(context, place, xs, ys, { colour: colour(), width: 1.2 });
      for (let k = 0; k < rows; k += history.phases)
        dot(context, place.x(xs[k]), place.y(ys[k]), 2.6 * place.ratio, theme().mark);
    },
  });
  portrait.host.append(
    chooser(pairs, 'Quantity of the phase portrait', (column) => {
      pair = column;
      portrait.view.full = extent(values(pair));
      portrait.view.x = [...portrait.view.full];
      portrait.panel.relabel();
    }),
  );
  return [over.host, portrait.host];
}

/// A place for the history of a point that the page does not have, where `serve` computes it.
export function computedHistory(study, point) {
  const place = element('div', { class: 'history' });
  return [place, longerHistory(study, point, place, () => theme().series[0], true)];
}

/// Of a page of `serve`: mesh periods that the server computes.
/// @param now  without being asked for
function longerHistory(study, point, place, colour, now) {
  const said = element('span', { role: 'status' });
  const periods = element(
    'select',
    { 'aria-label': 'Mesh periods of the history' },
    [4, 16, 64, 256].map((count) => element('option', { value: String(count), text: `${count} mesh periods` })),
  );
  const compute = async () => {
    said.textContent = 'Computing.';
    try {
      const { columns, ...history } = await study.live.history(study, point, Number(periods.value));
      const numbers = (name) => columns[name].map((value) => value ?? NaN);
      place.replaceChildren(...historyFigures({ ...history, columns: historyColumns, numbers }, colour));
      said.textContent = '';
    } catch (error) {
      said.textContent = `No history: ${error.message}.`;
    }
    releasePanels();
  };
  if (now) compute();
  return element(
    'div',
    { class: 'choosers' },
    periods,
    element('button', { type: 'button', text: 'Compute this history', onclick: compute }),
    said,
  );
}

/// Decodes, while nothing else is to do, the columns that the first chosen point of a sweep needs.
export function decodeAhead(study) {
  const idle = globalThis.requestIdleCallback ?? ((action) => setTimeout(action, 200));
  const needed = [
    [study.table('points.csv'), () => true],
    [study.table('section'), (name) => ['delta_sp_1', 'delta_sp_1_rate'].includes(name)],
    [study.table('histories'), (name) => ['delta_sp_1', 'delta_sp_1_rate'].includes(name)],
    [study.table('spectra'), () => true],
  ];
  const columns = needed.flatMap(([table, isNeeded]) =>
    (table?.columns ?? []).filter(({ name }) => isNeeded(name)).map(({ name }) => [table, name]),
  );
  const next = (deadline) => {
    do {
      const [table, name] = columns.shift() ?? [];
      if (!table) return;
      table.numbers(name);
    } while (deadline?.timeRemaining?.() > 5);
    idle(next);
  };
  idle(next);
}

export const shellWord = (text) => (/^[A-Za-z0-9_./+:=@%-]+$/.test(text) ? text : `'${text.replace(/'/g, "'\\''")}'`);

/// Speeds of the point, where known.
function speedText(table, row) {
  const parts = [
    ['sun_speed_rpm', 'sun', 'rpm'],
    ['carrier_speed_rpm', 'carrier', 'rpm'],
    ['mesh_frequency_Hz', 'mesh frequency', 'Hz'],
  ]
    .filter(([name]) => table.isNumeric(name) && Number.isFinite(table.numbers(name)[row]))
    .map(([name, words, unit]) => `${words} ${number(table.numbers(name)[row], 6)} ${unit}`);
  return parts.join(', ');
}

export function commandLine(text) {
  const code = element('code', { text });
  const button = element('button', {
    type: 'button',
    class: 'copy',
    text: 'Copy',
    onclick: async () => {
      const range = document.createRange();
      range.selectNodeContents(code);
      getSelection().removeAllRanges();
      getSelection().addRange(range);
      let copied = false;
      try {
        await navigator.clipboard.writeText(text);
        copied = true;
      } catch {
        copied = document.execCommand('copy');
      }
      button.textContent = copied ? 'Copied' : 'Selected';
    },
  });
  return element('p', { class: 'command' }, code, ' ', button);
}

/// Names what the bar above the panel leads to.
function part(name, node) {
  node.dataset.part = name;
  return node;
}

export function pointDetails(diagram, line, row) {
  const { study, table } = line;
  const index = table.numbers('point')[row];
  const value = table.numbers('value')[row];
  const colour = () => theme().classes[Math.max(0, line.classes[row])];
  const facts = [['Regime', diagram.regimeWords(line, row)], ...factsOf(table, row)];
  const made = element(
    'div',
    {},
    element(
      'h3',
      {},
      element('span', { class: `swatch class${Math.max(0, line.classes[row])}` }),
      `Point ${index}, ${line.direction}`,
    ),
    element(
      'p',
      {},
      rich(
        `${diagram.parameter.symbol} = ${number(value, 8)}${study.parameter.unit ? ` ${study.parameter.unit}` : ''}`,
      ),
      speedText(table, row) ? `; ${speedText(table, row)}.` : '.',
    ),
    tableOf(null, facts),
    torusNote(table, row),
  );
  const section = study.table('section');
  const starts = study.table('section_starts')?.numbers('start');
  if (section && starts) {
    const figure = sectionFigure(section, starts[row], starts[row + 1], colour);
    if (figure) made.append(part('Section', figure));
  }
  const history = storedHistory(study, row);
  const place = element('div', { class: 'history' }, history ? historyFigures(history, colour) : null);
  made.append(part('History', place));
  if (study.live) made.append(longerHistory(study, index, place, colour, !history));
  const spectrum = spectrumFigure(study, row, colour);
  if (spectrum) made.append(part('Spectrum', spectrum));
  const meshes = meshTables(table, row);
  if (meshes) made.append(part('Meshes', meshes));
  made.append(
    part('Command', element('h4', { text: 'To compute more at this point' })),
    element('p', { text: 'Long time histories, all forces, multipliers and exponents:' }),
    commandLine(`epicyclic run --from ${shellWord(`${study.folder}:${index}`)} -o ${shellWord(`point_${index}`)}`),
    part('All values', closedValues('All values of this point', table, row)),
  );
  return made;
}

export function orbitDetails(diagram, line, row) {
  const { study, table } = line;
  const stable = table.numbers('stable')[row] === 1;
  const made = element(
    'div',
    {},
    element('h3', { text: `Orbit ${table.numbers('index')[row]} of branch ${line.branch}` }),
    element(
      'p',
      {},
      rich(`${diagram.parameter.symbol} = ${number(table.numbers('value')[row], 8)}`),
      speedText(table, row) ? `; ${speedText(table, row)}.` : '.',
    ),
    tableOf(null, [
      ['Period', table.numbers('period')[row] === 1 ? '1 mesh period' : `${table.numbers('period')[row]} mesh periods`],
      [
        'Stability',
        stable ? 'stable' : `unstable, ${number(table.numbers('unstable')[row])} multipliers beyond the unit circle`,
      ],
      ['Largest multiplier, modulus', valueText(table, 'multiplier_max', row)],
    ]),
  );
  const section = study.table('section');
  const starts = study.table('section_starts')?.numbers('start');
  if (section && starts) {
    const figure = sectionFigure(section, starts[row], starts[row + 1], () => diagram.colour(line, row));
    if (figure) made.append(part('Section', figure));
  }
  const colour = () => diagram.colour(line, row);
  const multipliers = multiplierFigure(study, row, colour);
  if (multipliers) made.append(part('Multipliers', multipliers));
  const history = storedHistory(study, row);
  if (history) made.append(part('History', element('div', {}, historyFigures(history, colour))));
  if (history && !stable)
    made.append(element('p', { class: 'hint', text: 'The orbit is unstable: errors grow along this history.' }));
  const meshes = meshTables(table, row);
  if (meshes) made.append(part('Meshes', meshes));
  made.append(part('All values', closedValues('All values of this orbit', table, row)));
  return made;
}

export function specialDetails(diagram, point) {
  const table = point.study.table('special.csv');
  const [short, words] = specialName(point.kind);
  return element(
    'div',
    {},
    element('h3', { text: `${short}: ${words}` }),
    element(
      'p',
      {},
      rich(`${diagram.parameter.symbol} = ${withError(point.value, table.numbers('error_bound')[point.row])}`),
      speedText(table, point.row) ? `; ${speedText(table, point.row)}.` : '.',
    ),
    element('div', { class: 'scroll' }, allValues(table, point.row)),
    besideSpecial(diagram, point),
  );
}

/// The orbit of the branch before a special point.
function besideSpecial(diagram, point) {
  const line = diagram.lines.find(({ study, branch }) => study === point.study && branch === point.branch);
  if (!line) return null;
  const made = orbitDetails(diagram, line, point.before);
  made.querySelector('h3').textContent = `The orbit before it: ${made.querySelector('h3').textContent}`;
  return made;
}

/// Multipliers of an orbit of a branch.
function multiplierFigure(study, row, colour) {
  const table = study.table('multipliers');
  const count = study.multipliers_of_orbit;
  if (!table || (row + 1) * count > table.rows) return null;
  const [re, im] = ['real', 'imaginary'].map((name) => table.numbers(name).subarray(row * count, (row + 1) * count));
  return multipliersFigure(re, im, colour)?.host ?? null;
}

/// Multipliers beside the unit circle; those far outside are in the caption only.
/// @param errors  of each, to be shown with it; optional
/// @returns a smallFigure, or null if no multiplier is known
export function multipliersFigure(re, im, colour, errors) {
  const known = Array.from(re, (_, k) => k).filter((k) => Number.isFinite(re[k]));
  if (known.length === 0) return null;
  const limit = 3;
  const inside = known.filter((k) => Math.abs(re[k]) <= limit && Math.abs(im[k]) <= limit);
  const reach = Math.max(1.15, ...inside.map((k) => 1.1 * Math.max(Math.abs(re[k]), Math.abs(im[k]))));
  const text = (k) => `${number(re[k], 5)} ${im[k] < 0 ? '−' : '+'} ${number(Math.abs(im[k]), 5)} i`;
  const far = known.filter((k) => !inside.includes(k)).map(text);
  // Units of both axes are of one length.
  let figure = null;
  const wide = () => (figure ? figure.panel.plot.bbox.width / figure.panel.plot.bbox.height : 1.6);
  figure = smallFigure(
    `Floquet multipliers and the unit circle${far.length > 0 ? `; not drawn: ${far.join(', ')}` : ''}.`,
    {
      xLabel: () => 'Real part of μ',
      yLabel: () => 'Imaginary part of μ',
      xRange: () => [-1.6 * reach, 1.6 * reach],
      range: ([low, high]) => {
        const half = (0.5 * (high - low)) / wide();
        return [-half, half];
      },
      draw: (context, place) => {
        const angles = Array.from({ length: 181 }, (_, k) => (k * Math.PI) / 90);
        strokeLine(context, place, angles.map(Math.cos), angles.map(Math.sin), { colour: theme().faint, width: 1 });
        for (const k of inside) dot(context, place.x(re[k]), place.y(im[k]), 3 * place.ratio, colour());
      },
      hover: ({ left, top, x, y, ratio, leftOfPlot, topOfPlot }) => {
        const near = inside.find(
          (k) => Math.hypot((x(re[k]) - leftOfPlot) / ratio - left, (y(im[k]) - topOfPlot) / ratio - top) < 8,
        );
        return near === undefined
          ? null
          : {
              text: `${text(near)}\nmodulus ${number(Math.hypot(re[near], im[near]), 6)}${errors ? `\nerror ${number(errors[near], 2)}` : ''}`,
            };
      },
    },
  );
  const fit = () => {
    figure.view.full = [-reach * wide(), reach * wide()];
    figure.view.reset();
  };
  new ResizeObserver(fit).observe(figure.host);
  return figure;
}

/// Parts of a long panel, to go to each; they stay above it while it is scrolled. What is left below is announced at its
/// lower edge.
function partsOf(place, made) {
  const parts = [...made.querySelectorAll('[data-part]')];
  const go = (part) => {
    if (part.tagName === 'DETAILS') part.open = true;
    if (place.scrollHeight > place.clientHeight) place.scrollTop = part.offsetTop - bar.offsetHeight - 6;
    else part.scrollIntoView();
  };
  const bar = element(
    'nav',
    { class: 'parts', 'aria-label': 'Parts of this panel' },
    [made.firstChild, ...parts].map((part) =>
      element('button', {
        type: 'button',
        class: 'link',
        text: part.dataset.part ?? 'Top',
        onclick: () => go(part),
      }),
    ),
  );
  const below = element('button', {
    type: 'button',
    class: 'below',
    text: 'More below ▾',
    onclick: () => place.scrollBy({ top: 0.8 * place.clientHeight }),
  });
  return { bar: parts.length > 0 ? bar : null, below };
}

/// Puts what was chosen beside the figure. Screen readers say its heading and its first line, and not all of it.
export function showDetails(place, made) {
  const said = ['h3', 'p'].map((tag) => made.querySelector(tag)?.textContent ?? '').join('. ');
  const status = place.querySelector('[role=status]') ?? element('p', { role: 'status', class: 'unseen' });
  const { bar, below } = partsOf(place, made);
  place.replaceChildren(...[status, bar, made, below].filter(Boolean));
  place.scrollTop = 0;
  const update = () => (below.hidden = place.scrollTop + place.clientHeight > place.scrollHeight - 24);
  place.onscroll = update;
  fitted.add(place);
  fit();
  growth.get(place)?.disconnect();
  growth.set(place, new ResizeObserver(update));
  for (const node of [place, made]) growth.get(place).observe(node);
  releasePanels();
  status.textContent = said;
}

const growth = new WeakMap(); // observers of panels

/// Beside the figure a panel ends at the lower edge of the window, wherever it begins.
const fitted = new Set();
function fit() {
  for (const place of fitted) {
    if (!place.isConnected) fitted.delete(place);
    const beside = innerWidth >= 1280 && !place.classList.contains('wide');
    const height = Math.max(320, innerHeight - Math.max(8, place.getBoundingClientRect().top) - 8);
    place.style.maxHeight = beside ? `${Math.round(height)}px` : '';
  }
}
for (const event of ['scroll', 'resize']) addEventListener(event, fit, { passive: true });
addEventListener('beforeprint', () => fitted.forEach((place) => (place.style.maxHeight = '')));
addEventListener('afterprint', fit);

/// What an interval of the exponent that excludes 0 means for a torus; null if it does not.
function torusNote(table, row) {
  if (!table.has('regime') || table.word('regime', row) !== 'quasiperiodic') return null;
  const [value, error] = ['lyapunov_max', 'lyapunov_max_error'].map((name) => table.numbers(name)[row]);
  if (!(Math.abs(value) > error)) return null;
  return element(
    'p',
    { class: 'hint torus' },
    rich('On a torus λ_1 is 0, but a finite average approaches it slowly, so that its 95 % interval may exclude 0 '),
    '(docs/reference/regimes.md).',
  );
}

/// What stands first of a point: evidence, exponent, multiplier, errors.
function factsOf(table, row) {
  const words = [
    ['evidence', 'Evidence'],
    ['message', 'Message'],
    ['lyapunov_max', 'Largest Lyapunov exponent λ_1'],
    ['multiplier_max', 'Largest Floquet multiplier, modulus'],
    ['orbit_error', 'Error bound of the orbit'],
    ['zero_one', 'K of the 0-1 test'],
    ['classified_periods', 'Integrated to classify'],
  ];
  return words
    .filter(([name]) => table.has(name) && valueText(table, name, row) !== '')
    .map(([name, text]) => [text, capital(valueText(table, name, row))]);
}

/// A row of any table: what stands first of it and its meshes, or else everything.
export function rowDetails(table, row, title, lead) {
  const facts = factsOf(table, row);
  const meshes = meshTables(table, row);
  return element(
    'div',
    {},
    element('h3', { text: title }),
    lead ? element('p', { text: lead }) : null,
    facts.length > 0 ? tableOf(null, facts) : null,
    torusNote(table, row),
    meshes,
    meshes ? closedValues('All values', table, row) : element('div', { class: 'scroll' }, allValues(table, row)),
  );
}
