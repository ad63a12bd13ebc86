// One operating point: histories, phase portrait, section, spectra, exponents and multipliers from its tables.
import { Panel, View, dot, strokeLine } from './panel.js';
import { theme } from './theme.js';
import { axisLabel, capital, element, factorOf, lengthUnit, number, symbol, unitText } from './words.js';
import { extent, multipliersFigure, rowDetails, sectionFigure, smallFigure } from './details.js';

const label = (column) =>
  `${symbol(column.name) || (column.meaning ? capital(column.meaning) : column.name)}${unitText(column.unit) ? `  [${unitText(column.unit)}]` : ''}`;
const scaled = (table, name) =>
  Float64Array.from(table.numbers(name), (value) => factorOf(table.byName.get(name).unit) * value);
const selectOf = (text, columns, current, action) => {
  const made = element(
    'select',
    { onchange: () => action(columns[made.selectedIndex]) },
    columns.map((column) => element('option', { text: column.name, selected: column === current })),
  );
  return element('label', {}, element('span', { text }), made);
};

export class Run {
  constructor(study, host) {
    this.panels = [];
    const units = element(
      'select',
      {
        onchange: () => {
          lengthUnit.micrometres = units.selectedIndex === 1;
          for (const panel of this.panels) panel.relabel();
        },
      },
      ['b_c', 'µm'].map((text) => element('option', { text })),
    );
    const figures = element('div', { class: 'grid' });
    host.append(
      element('div', { class: 'toolbar' }, element('label', {}, element('span', { text: 'Lengths in' }), units)),
      figures,
    );
    this.history(study.table('history.csv'), figures);
    this.portrait(study.table('history.csv'), figures);
    const section = study.table('section');
    if (section) {
      const made = sectionFigure(section, 0, section.rows, () => theme().series[0]);
      if (made) figures.append(made);
    }
    this.spectrum(study.table('spectrum.csv'), figures);
    this.exponents(study.table('exponents.csv'), figures);
    this.multipliers(study.table('multipliers.csv'), figures);
    const point = study.table('points.csv');
    if (point?.rows > 0)
      host.append(element('section', { class: 'details wide' }, rowDetails(point, 0, 'The operating point')));
  }

  add(host, caption, options, chooser) {
    const made = smallFigure(caption, options);
    if (chooser) made.host.append(chooser(made));
    this.panels.push(made.panel);
    host.append(made.host);
    return made;
  }

  history(table, host) {
    if (!table) return;
    const times = table.columns.filter(({ name }) => ['periods', 'tau', 'time_s'].includes(name));
    const columns = table.columns.filter((column) => !times.includes(column) && column.form !== 'words');
    let time = times[0];
    let shown = columns.find(({ name }) => name === 'delta_sp_1') ?? columns[0];
    const host_ = element('figure', { class: 'small wide' });
    const view = new View(extent(table.numbers(time.name), 0));
    const panel = new Panel({
      host: host_,
      view,
      height: () => 260,
      xLabel: () => label(time),
      yLabel: () => label(shown),
      range: () => extent(scaled(table, shown.name)),
      draw: (context, place) =>
        strokeLine(context, place, table.numbers(time.name), scaled(table, shown.name), { colour: theme().series[0] }),
      hover: ({ left }) => {
        const xs = table.numbers(time.name);
        const at = panel.plot.posToVal(left, 'x');
        let best = 0;
        for (let i = 1; i < xs.length; ++i) if (Math.abs(xs[i] - at) < Math.abs(xs[best] - at)) best = i;
        return {
          text: `${time.name} = ${number(xs[best])}\n${shown.name} = ${number(scaled(table, shown.name)[best])} ${unitText(shown.unit)}`,
        };
      },
    });
    this.panels.push(panel);
    host_.append(
      element('figcaption', { text: 'Time history. Drag to zoom, double-click to show all.' }),
      element(
        'div',
        { class: 'choosers' },
        selectOf('Quantity', columns, shown, (column) => ((shown = column), panel.relabel())),
        selectOf('Time', times, time, (column) => {
          time = column;
          view.full = extent(table.numbers(time.name), 0);
          view.x = [...view.full];
          panel.relabel();
        }),
      ),
    );
    host.append(host_);
  }

  portrait(table, host) {
    if (!table) return;
    const pairs = table.columns.filter(({ name }) => table.has(`${name}_rate`));
    if (pairs.length === 0) return;
    let shown = pairs.find(({ name }) => name === 'delta_sp_1') ?? pairs[0];
    const rate = () => table.byName.get(`${shown.name}_rate`);
    this.add(
      host,
      'Phase portrait: a quantity and its rate.',
      {
        xLabel: () => label(shown),
        yLabel: () => label(rate()),
        xRange: () => extent(scaled(table, shown.name)),
        range: () => extent(table.numbers(rate().name)),
        draw: (context, place) =>
          strokeLine(context, place, scaled(table, shown.name), table.numbers(rate().name), {
            colour: theme().series[0],
            width: 1.1,
          }),
      },
      ({ panel, view }) =>
        element(
          'div',
          { class: 'choosers' },
          selectOf('Quantity', pairs, shown, (column) => {
            shown = column;
            view.full = extent(scaled(table, shown.name));
            view.x = [...view.full];
            panel.relabel();
          }),
        ),
    );
  }

  spectrum(table, host) {
    if (!table) return;
    const signals = [...new Set(Array.from({ length: table.rows }, (_, row) => table.word('signal', row)))];
    let shown = signals.includes('delta_sp_1') ? 'delta_sp_1' : signals[0];
    const [frequency, amplitude] = ['frequency', 'amplitude'].map((name) => table.numbers(name));
    const linesOf = (signal) => {
      const rows = Array.from({ length: table.rows }, (_, row) => row).filter(
        (row) => table.word('signal', row) === signal && amplitude[row] > 0,
      );
      return { rows, unit: table.word('unit', rows[0] ?? 0) };
    };
    let lines = linesOf(shown);
    this.add(
      host,
      'Amplitude spectrum, zero to peak.',
      {
        xLabel: () => 'Frequency over the mesh frequency',
        yLabel: () => axisLabel({ name: shown, unit: lines.unit }),
        logarithmic: () => true,
        xRange: () => extent(frequency, 0.01),
        hover: ({ left, xAt }) => {
          const at = xAt(left);
          let best = lines.rows[0];
          for (const row of lines.rows) if (Math.abs(frequency[row] - at) < Math.abs(frequency[best] - at)) best = row;
          if (best === undefined) return null;
          const value = `${number(factorOf(lines.unit) * amplitude[best], 4)} ${unitText(lines.unit)}`;
          return { text: `frequency ${number(frequency[best], 6)} ω_m\namplitude ${value}` };
        },
        range: () => {
          const factor = factorOf(lines.unit);
          let [low, high] = [Infinity, 0];
          for (const row of lines.rows)
            [low, high] = [Math.min(low, factor * amplitude[row]), Math.max(high, factor * amplitude[row])];
          return [Math.max(low, 1e-8 * high), 2 * high];
        },
        draw: (context, place) => {
          const factor = factorOf(lines.unit);
          context.strokeStyle = theme().series[0];
          context.lineWidth = 1.2 * place.ratio;
          context.beginPath();
          for (const row of lines.rows) {
            context.moveTo(place.x(frequency[row]), place.top + place.height);
            context.lineTo(place.x(frequency[row]), place.y(factor * amplitude[row]));
          }
          context.stroke();
        },
      },
      ({ panel }) =>
        element(
          'div',
          { class: 'choosers' },
          selectOf(
            'Signal',
            signals.map((name) => ({ name })),
            null,
            ({ name }) => {
              shown = name;
              lines = linesOf(shown);
              panel.relabel();
            },
          ),
        ),
    );
  }

  exponents(table, host) {
    if (!table) return;
    const columns = table.columns.filter(({ name }) => name.startsWith('lambda_'));
    const xs = table.numbers('periods');
    this.add(
      host,
      `Lyapunov exponents: running means over the mesh periods. The largest is in colour, the other ${columns.length - 1} in grey.`,
      {
        xLabel: () => 'Mesh periods',
        yLabel: () => 'Exponent  [per τ]',
        xRange: () => extent(xs, 0),
        range: () =>
          columns
            .map(({ name }) => extent(table.numbers(name)))
            .reduce(([a, b], [c, d]) => [Math.min(a, c), Math.max(b, d)]),
        draw: (context, place) =>
          columns
            .toReversed()
            .forEach(({ name }) =>
              strokeLine(
                context,
                place,
                xs,
                table.numbers(name),
                name === 'lambda_1' ? { colour: theme().series[1], width: 2 } : { colour: theme().faint, width: 0.8 },
              ),
            ),
      },
    );
  }

  multipliers(table, host) {
    if (!table) return;
    const [re, im, error] = ['re', 'im', 'error'].map((name) => table.numbers(name));
    const made = multipliersFigure(re, im, () => theme().series[0], error);
    if (!made) return;
    this.panels.push(made.panel);
    host.append(made.host);
  }
}

export const titleOfTable = (table) => (table.title ? `${capital(table.title)} (${table.name})` : table.name);
