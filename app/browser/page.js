// Puts the page together from the data: a part for each study, or for studies that go into one diagram.
import { readPayload } from './payload.js';
import { capital, element, lengthUnit, number, rich, tableOf, unitText } from './words.js';
import { Diagram } from './diagram.js';
import { Plane } from './plane.js';
import { Run, titleOfTable } from './run.js';
import { commandLine, decodeAhead } from './details.js';
import { chartOf, hasUsualChart } from './chart.js';
import { Live } from './live.js';
import { hasModes, modesFigure } from './modes.js';
import { summaryOf } from './summary.js';

const kindWords = new Map(
  Object.entries({
    sweep: 'Sweep of one parameter',
    continue: 'Branches of periodic orbits',
    map: 'Map over two parameters',
    basins: 'Basins of attraction',
    run: 'One operating point',
    crosscheck: 'Check by other methods',
    tolerance: 'Errors at several tolerances',
    gear: 'Geometry, stiffness and modes of a stage',
  }),
);

/// Studies that go into one diagram: sweeps and branches over the same parameter.
function groupsOf(studies) {
  const groups = [];
  for (const study of studies) {
    const alike =
      ['sweep', 'continue'].includes(study.kind) &&
      groups.find(
        ([first]) => ['sweep', 'continue'].includes(first.kind) && first.parameter.name === study.parameter.name,
      );
    if (alike) alike.push(study);
    else groups.push([study]);
  }
  return groups;
}

/// @param memory  of the figure that was there before
/// @returns the figure of the points, or null
function figuresOf(group, host, memory) {
  const [study] = group;
  const kinds = {
    sweep: () => new Diagram(group, host, memory),
    continue: () => new Diagram(group, host, memory),
    map: () => new Plane(study, host, memory),
    basins: () => new Plane(study, host, memory),
    run: () => new Run(study, host),
  };
  const needed = {
    sweep: 'points.csv',
    continue: 'branch.csv',
    map: 'points.csv',
    basins: 'points.csv',
    run: 'points.csv',
  };
  const drawn = kinds[study.kind] && group.some((one) => one.table(needed[one.kind])?.rows > 0);
  const figure = drawn ? kinds[study.kind]() : null;
  // Of a sweep the cross-check of some points is a table.
  const isDrawn = (table) => hasUsualChart(table) && !(drawn && table.name === 'crosscheck.csv');
  const charts = group
    .flatMap((one) => {
      const labels = { value: one.parameter.label, first: one.parameter.label, second: one.second_parameter?.label };
      return one.tables.filter(isDrawn).map((table) => chartOf(table, `${titleOfTable(table)}.`, labels));
    })
    .filter(Boolean);
  charts.unshift(...group.filter(hasModes).map(modesFigure));
  if (charts.length > 0) host.append(element('div', { class: 'grid' }, charts));
  else if (!drawn)
    host.append(
      element('p', { class: 'hint', text: 'This report draws no figure of this study. Its tables are below.' }),
    );
  return figure;
}

/// Keys of the input, object by object, with unit and origin.
function inputOf(study) {
  const groups = new Map();
  for (const entry of study.input) {
    const parent = entry.pointer.replace(/\/[^/]*$/, '');
    if (!groups.has(parent)) groups.set(parent, []);
    groups.get(parent).push(entry);
  }
  const order = ['', '/study', '/operation', '/model', '/integrator', '/stage'];
  const place = (parent) =>
    parent === '' ? 0 : order.findIndex((begin, k) => k > 0 && `${parent}/`.startsWith(`${begin}/`)) + 1 || 99;
  const table = tableOf(['Key', 'Value', 'Unit', 'Origin', 'Meaning'], []);
  table.classList.add('input');
  for (const [parent, entries] of [...groups].sort(([a], [b]) => place(a) - place(b))) {
    const rows = tableOf(
      null,
      entries.map((entry) => [
        element('code', {
          text: entry.pointer
            .slice(parent.length + 1)
            .replace(/~1/g, '/')
            .replace(/~0/g, '~'),
        }),
        typeof entry.value === 'number'
          ? number(entry.value, 12)
          : element('span', { text: typeof entry.value === 'string' ? entry.value : JSON.stringify(entry.value) }),
        unitText(entry.unit),
        element('span', { text: entry.origin ?? 'given' }),
        element('span', { text: capital(entry.meaning ?? '') }),
      ]),
    ).lastChild;
    rows.prepend(
      element(
        'tr',
        {},
        element('th', { colspan: '5', scope: 'rowgroup', class: 'group' }, element('code', { text: parent || '/' })),
      ),
    );
    table.append(rows);
  }
  return table;
}

const folded = (title, ...content) =>
  element('details', {}, element('summary', { text: title }), element('div', { class: 'scroll' }, ...content.flat()));

const rowsShown = 200;

function tableShown(table) {
  const rows = () =>
    Array.from({ length: Math.min(table.rows, rowsShown) }, (_, row) =>
      table.columns.map(({ name, form }) =>
        form === 'words' ? element('span', { text: table.word(name, row) }) : number(table.numbers(name)[row], 7),
      ),
    );
  const made = folded(`${titleOfTable(table)}: ${table.rows} ${table.rows === 1 ? 'row' : 'rows'}`);
  // Built when it is opened.
  made.addEventListener('toggle', () => {
    const place = made.lastChild;
    if (place.childElementCount > 0) return;
    const grid = tableOf(
      table.columns.map(({ name, unit, meaning }) =>
        element('span', { title: meaning }, name, unitText(unit) ? ` [${unitText(unit)}]` : ''),
      ),
      rows(),
    );
    grid.classList.add('rows');
    const chart = chartOf(table, 'Any two columns of this table.');
    if (chart) place.before(chart);
    place.append(grid);
    if (table.rows > rowsShown)
      place.append(
        element('p', {
          text: `The first ${rowsShown} rows are shown. ${table.name} in the folder of the study has all.`,
        }),
      );
  });
  return made;
}

function aboutOf(study, header) {
  const { run } = study;
  const libraries = Object.entries(run.dependencies ?? {})
    .map(([name, version]) => `${name} ${version}`)
    .join(', ');
  const rows = [
    ['Folder', element('code', { text: study.folder })],
    ['State', run.state === 'complete' ? 'complete' : `not complete (${run.state})`],
    ['Computed by', `epicyclic ${run.version ?? '?'}, commit ${run.commit ?? '?'}`],
    ['Written by', `epicyclic ${header.program.version}, commit ${header.program.commit}`],
    ['Computed', [run.started, run.ended].filter(Boolean).join(' to ')],
    ['Instruction set', run.simd ?? ''],
    ['Libraries', libraries],
    ['Identity of the study', element('code', { class: 'break', text: run.identity })],
    ...study.tolerance.map(([name, value]) => [name, value]),
  ];
  return tableOf(
    null,
    rows.filter(([, value]) => value !== ''),
  );
}

function symbolsOf(study) {
  return element(
    'dl',
    { class: 'symbols' },
    study.symbols.flatMap(([name, words]) => [element('dt', {}, rich(name)), element('dd', {}, rich(words))]),
  );
}

/// The title, with the folder where another study has the same one.
const headingOf = (study, studies) =>
  studies.some((other) => other !== study && !other.derived && other.title === study.title)
    ? `${study.title} (${study.label})`
    : study.title;

function partOf(group, header) {
  const part = element('section', { class: 'study' });
  for (const study of group) {
    // What `serve` has computed of a study is described by its history.
    if (study.derived) continue;
    part.append(
      header.studies.length > 1 ? element('h2', { text: headingOf(study, header.studies) }) : '',
      element('p', { class: 'lead' }, rich(`${kindWords.get(study.kind) ?? capital(study.kind)}. ${study.lead}`)),
    );
    if (study.note) part.append(element('p', { class: 'note', text: study.note }));
    if (study.run.state !== 'complete')
      part.append(
        element('p', {
          class: 'warning',
          text: `This study is not complete: ${study.progress}. ${study.live ? 'Its points appear here as they are finished.' : 'Repeat its command to complete it.'}`,
        }),
      );
    for (const warning of study.warnings) part.append(element('p', { class: 'warning', text: capital(warning) }));
  }
  const host = element('div', { class: 'figures' });
  part.append(host);
  for (const study of group) {
    const several = group.length > 1 ? `${study.derived ? study.label : study.title}: ` : '';
    const hidden = ['section', 'section_starts', 'spectra', 'histories', 'multipliers', 'change_multipliers'];
    study.summaries?.forEach(({ name, text }, k) => {
      const made = folded(`${several}Results in words (${name})`, summaryOf(text));
      made.open = k === 0 && !study.derived;
      part.append(made);
    });
    part.append(
      study.derived ? '' : folded(`${several}Symbols`, symbolsOf(study)),
      folded(
        `${several}Input: values, units and origins`,
        element(
          'p',
          {},
          'Each value with its origin. ',
          element('code', { text: 'given' }),
          ' is a value of the input file.',
        ),
        inputOf(study),
      ),
      folded(
        `${several}Versions, tolerances and how to repeat it`,
        aboutOf(study, header),
        study.command ? [element('p', { text: 'The same study again:' }), commandLine(study.command)] : [],
      ),
      element(
        'details',
        {},
        element('summary', { text: `${several}Tables` }),
        ...study.tables.filter(({ name }) => !hidden.includes(name)).map(tableShown),
      ),
      folded(
        `${several}What this file does not have`,
        element(
          'ul',
          {},
          study.left_out.map((text) => element('li', { text })),
        ),
      ),
    );
  }
  return [part, host];
}

async function show() {
  const page = document.getElementById('page');
  try {
    const header = await readPayload(document.getElementById('data').textContent);
    lengthUnit.um_per_b_c = header.um_per_b_c;
    if (header.live) {
      const build = { groups: groupsOf, part: partOf, figures: figuresOf };
      await new Live(page, build).start();
      document.body.dataset.state = 'ready';
      return;
    }
    page.replaceChildren();
    for (const group of groupsOf(header.studies)) {
      const [part, host] = partOf(group, header);
      page.append(part);
      figuresOf(group, host);
    }
    for (const study of header.studies) if (study.kind === 'sweep') decodeAhead(study);
    document.body.dataset.state = 'ready';
  } catch (error) {
    page.replaceChildren(
      element('p', {
        class: 'warning',
        text: `This page cannot show its data: ${error.message}. A browser of 2023 or later is needed.`,
      }),
    );
    document.body.dataset.state = 'failed';
    throw error;
  }
}

show();
