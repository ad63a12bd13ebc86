// Maps and basins: a cell for each pair of values, coloured by what is known of it; hover and click.
import { Panel, View } from './panel.js';
import { rgb, shade, theme } from './theme.js';
import { axisLabel, element, factorOf, number, unitText } from './words.js';
import { classNames, classesOf } from './diagram.js';
import { quantityChooser } from './choice.js';
import { commandLine, computedHistory, rowDetails, shellWord, showDetails } from './details.js';

export class Plane {
  /// @param memory  by remember(), of the same study when it had fewer cells
  constructor(study, host, memory) {
    this.study = study;
    this.table = study.table('points.csv');
    this.classes = classesOf(this.table);
    const distinct = (name) => [...new Set(this.table.numbers(name))].filter(Number.isFinite).sort((a, b) => a - b);
    this.xs = distinct('value');
    this.ys = distinct('second_value');
    this.directions = this.table.has('direction')
      ? [...new Set(Array.from({ length: this.table.rows }, (_, row) => this.table.word('direction', row)))]
      : [''];
    this.direction = this.directions[0];
    this.quantities = [{ name: 'regime', form: 'classes', meaning: 'with the period of periodic orbits' }];
    if (this.table.has('attractor'))
      this.quantities.unshift({ name: 'attractor', form: 'attractors', meaning: 'number of the attractor' });
    for (const column of this.table.columns)
      if (column.form !== 'words' && !['point', 'value', 'second_value', 'attractor'].includes(column.name))
        this.quantities.push(column);
    this.quantity = this.quantities.find(({ name }) => name === memory?.quantity) ?? this.quantities[0];
    if (this.directions.includes(memory?.direction)) this.direction = memory.direction;
    this.index();
    this.build(host, memory);
  }

  /// What a reader has chosen. Cells are numbered by their values, of which there may be more later.
  remember() {
    const { x, full } = this.view;
    return {
      quantity: this.quantity.name,
      direction: this.direction,
      view: x[0] === full[0] && x[1] === full[1] ? null : x,
      y: this.panel.y,
      point: this.chosen >= 0 ? this.table.numbers('point')[this.cells[this.chosen]] : undefined,
      details: this.details,
    };
  }

  index() {
    const [value, second] = [this.table.numbers('value'), this.table.numbers('second_value')];
    const [xAt, yAt] = [new Map(this.xs.map((x, i) => [x, i])), new Map(this.ys.map((y, i) => [y, i]))];
    this.cells = new Int32Array(this.xs.length * this.ys.length).fill(-1);
    for (let row = 0; row < this.table.rows; ++row)
      if (!this.table.has('direction') || this.table.word('direction', row) === this.direction)
        this.cells[yAt.get(second[row]) * this.xs.length + xAt.get(value[row])] = row;
  }

  /// [low, high] of a quantity that has a scale.
  limits() {
    const values = this.table.numbers(this.quantity.name);
    let [low, high] = [Infinity, -Infinity];
    for (const row of this.cells)
      if (row >= 0 && this.classes[row] !== -1 && Number.isFinite(values[row]))
        [low, high] = [Math.min(low, values[row]), Math.max(high, values[row])];
    if (this.quantity.name === 'lyapunov_max') return [-Math.max(-low, high), Math.max(-low, high)];
    return low <= high ? [low, high] : [0, 1];
  }

  colourOf(row, limits) {
    const colours = theme();
    if (row < 0) return rgb(colours.paper);
    if (this.quantity.form === 'classes')
      return this.classes[row] === -1 ? rgb(colours.empty) : rgb(colours.classes[this.classes[row]]);
    const value = this.table.numbers(this.quantity.name)[row];
    if (this.quantity.form === 'attractors')
      return value > 0 ? rgb(colours.series[(value - 1) % 10]) : rgb(colours.empty);
    if (this.classes[row] === -1 || !Number.isFinite(value)) return rgb(colours.empty);
    const part = limits[1] > limits[0] ? (value - limits[0]) / (limits[1] - limits[0]) : 0.5;
    return shade(this.quantity.name === 'lyapunov_max' ? colours.diverging : colours.scale, part);
  }

  draw(context, place) {
    const limits = this.quantity.form === 'classes' || this.quantity.form === 'attractors' ? null : this.limits();
    const canvas = new OffscreenCanvas(this.xs.length, this.ys.length);
    const image = new ImageData(this.xs.length, this.ys.length);
    for (let j = 0; j < this.ys.length; ++j)
      for (let i = 0; i < this.xs.length; ++i)
        image.data.set(
          [...this.colourOf(this.cells[j * this.xs.length + i], limits), 255],
          4 * ((this.ys.length - 1 - j) * this.xs.length + i),
        );
    canvas.getContext('2d').putImageData(image, 0, 0);
    context.imageSmoothingEnabled = false;
    const [x0, x1] = edges(this.xs);
    const [y0, y1] = edges(this.ys);
    context.drawImage(canvas, place.x(x0), place.y(y1), place.x(x1) - place.x(x0), place.y(y0) - place.y(y1));
    if (this.chosen >= 0) {
      const [i, j] = [this.chosen % this.xs.length, Math.floor(this.chosen / this.xs.length)];
      const [wide, tall] = [(x1 - x0) / this.xs.length, (y1 - y0) / this.ys.length];
      // In two colours, of which one is seen on any cell.
      for (const [colour, width] of [
        [theme().paper, 5],
        [theme().mark, 2],
      ]) {
        context.strokeStyle = colour;
        context.lineWidth = width * place.ratio;
        context.strokeRect(
          place.x(x0 + i * wide),
          place.y(y0 + (j + 1) * tall),
          place.x(wide) - place.x(0),
          place.y(0) - place.y(tall),
        );
      }
    }
  }

  cellAt(x, y) {
    const part = (value, values) => {
      const [low, high] = edges(values);
      return Math.floor(((value - low) / (high - low)) * values.length);
    };
    const [i, j] = [part(x, this.xs), part(y, this.ys)];
    return i >= 0 && j >= 0 && i < this.xs.length && j < this.ys.length ? j * this.xs.length + i : -1;
  }

  words(cell) {
    const row = this.cells[cell];
    const { parameter, second_parameter: second } = this.study;
    const at = `${parameter.symbol} = ${number(this.xs[cell % this.xs.length])}, ${second.symbol} = ${number(this.ys[Math.floor(cell / this.xs.length)])}`;
    if (row < 0) return `${at}\nnot computed`;
    const of = this.classes[row];
    const regime =
      of === -1
        ? 'not reached'
        : `${this.table.word('regime', row)}${of <= 1 ? `, period ${this.table.numbers('period')[row]}` : ''}`;
    const column = this.table.byName.get(this.quantity.name);
    const value =
      column && column.form !== 'words'
        ? `\n${column.name} = ${number(factorOf(column.unit) * this.table.numbers(column.name)[row])} ${unitText(column.unit)}`
        : '';
    return `${at}\n${regime}${value}`;
  }

  choose(cell) {
    const row = this.cells[cell];
    if (row === undefined || row < 0) return;
    this.chosen = cell;
    const index = this.table.numbers('point')[row];
    const made = rowDetails(this.table, row, `Cell ${index}`, this.words(cell).replace(/\n/g, '; '));
    if (this.study.table('attractors.csv') && this.table.has('attractor')) {
      const all = this.study.table('attractors.csv');
      const found = Array.from(all.numbers('attractor')).indexOf(this.table.numbers('attractor')[row]);
      if (found >= 0) made.append(rowDetails(all, found, `Attractor ${all.numbers('attractor')[found]}`));
    }
    if (this.study.live) made.append(...computedHistory(this.study, index));
    made.append(
      element('h4', { text: 'To compute more at this cell' }),
      commandLine(
        `epicyclic run --from ${shellWord(`${this.study.folder}:${index}`)} -o ${shellWord(`cell_${index}`)}`,
      ),
    );
    showDetails(this.details, made);
    this.panel.redraw();
  }

  key(event) {
    const cell = this.chosen ?? this.cells.findIndex((row) => row >= 0);
    const move = (dx, dy) => {
      if (this.chosen === undefined) return this.choose(cell);
      const [i, j] = [(cell % this.xs.length) + dx, Math.floor(cell / this.xs.length) + dy];
      if (i >= 0 && j >= 0 && i < this.xs.length && j < this.ys.length) this.choose(j * this.xs.length + i);
    };
    const actions = {
      ArrowRight: () => move(1, 0),
      ArrowLeft: () => move(-1, 0),
      ArrowUp: () => move(0, 1),
      ArrowDown: () => move(0, -1),
      '+': () => this.view.zoom(0.5),
      '=': () => this.view.zoom(0.5),
      '-': () => this.view.zoom(2),
      0: () => this.view.reset(),
    };
    if (!actions[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    actions[event.key]();
  }

  build(host, memory) {
    this.view = new View(edges(this.xs));
    if (memory?.view) this.view.x = [...memory.view];
    if (memory?.point !== undefined)
      this.chosen = this.cells.findIndex((row) => row >= 0 && this.table.numbers('point')[row] === memory.point);
    this.details =
      memory?.details ??
      element(
        'section',
        { class: 'details', 'aria-label': 'The chosen cell' },
        element('p', { class: 'hint', text: 'Choose a cell: click on it, or use the arrow keys in the figure.' }),
      );
    const figure = element('div', {
      class: 'figure',
      tabIndex: 0,
      role: 'group',
      'aria-label': 'Cells. Arrow keys choose a cell, + and − zoom, 0 shows all.',
      onkeydown: (event) => this.key(event),
    });
    const chooser = quantityChooser(
      this.quantities.map((column) => ({
        column,
        value: column.name,
        group: ['classes', 'attractors'].includes(column.form) ? 'Regimes and attractors' : undefined,
      })),
      this.quantity.name,
      ({ column }) => {
        this.quantity = column;
        this.refresh();
      },
      { id: 'quantity' },
    );
    const directions = element(
      'select',
      {
        onchange: () => {
          this.direction = this.directions[directions.selectedIndex];
          this.index();
          this.refresh();
        },
      },
      this.directions.map((text) => element('option', { text, selected: text === this.direction })),
    );
    const field = (text, control) => element('label', {}, element('span', { text }), control);
    host.append(
      element(
        'div',
        { class: 'toolbar' },
        field('Colour by', chooser.select),
        chooser.filter && field('Find a quantity', chooser.filter),
        this.directions.length > 1 ? field('Direction', directions) : null,
        element(
          'span',
          { class: 'buttons' },
          element('button', { type: 'button', text: 'All', title: 'Show all', onclick: () => this.view.reset() }),
        ),
      ),
      element(
        'div',
        { class: 'columns' },
        element(
          'div',
          { class: 'main' },
          figure,
          (this.legendHost = element('div')),
          element('p', {
            class: 'hint',
            text: 'Drag to zoom; use the wheel with Ctrl to zoom, with Alt along the ordinate; double-click to show all. Arrow keys go from cell to cell.',
          }),
        ),
        this.details,
      ),
    );
    this.panel = new Panel({
      host: figure,
      view: this.view,
      height: () => Math.max(280, Math.min(520, Math.round(0.75 * figure.clientWidth))),
      xLabel: () => this.study.parameter.label,
      yLabel: () => this.study.second_parameter.label,
      range: () => edges(this.ys),
      draw: (context, place) => this.draw(context, place),
      hover: ({ left, top }) => {
        const cell = this.cellAt(this.panel.plot.posToVal(left, 'x'), this.panel.plot.posToVal(top, 'y'));
        return cell < 0 ? null : { cell, text: this.words(cell) };
      },
      pick: ({ cell }) => this.choose(cell),
    });
    if (memory?.y) this.panel.y = memory.y;
    this.refresh();
  }

  refresh() {
    const rows = [...this.cells].filter((row) => row >= 0);
    const item = (swatch, text) => element('li', {}, element('span', { class: `swatch ${swatch}` }), text);
    if (this.quantity.form === 'classes') {
      this.legendHost.replaceChildren(
        element(
          'ul',
          { class: 'legend' },
          classNames.map((name, k) => {
            const count = rows.filter((row) => this.classes[row] === k).length;
            return count > 0 ? item(`class${k}`, `${name}: ${counted(count)}`) : null;
          }),
          rows.some((row) => this.classes[row] === -1) ? item('empty', 'not reached') : null,
        ),
      );
    } else if (this.quantity.form === 'attractors') {
      const all = this.table.numbers('attractor');
      const names = [...new Set(rows.map((row) => all[row]))].sort((a, b) => a - b);
      const repeated = names.length > 10 ? element('li', { text: 'Colours repeat after ten attractors.' }) : null;
      this.legendHost.replaceChildren(
        element(
          'ul',
          { class: 'legend' },
          names.map((name) =>
            item(
              name > 0 ? `series${(name - 1) % 10}` : 'empty',
              name > 0 ? `attractor ${name}: ${counted(rows.filter((row) => all[row] === name).length)}` : 'none',
            ),
          ),
          repeated,
        ),
      );
    } else {
      const [low, high] = this.limits();
      const factor = factorOf(this.quantity.unit);
      const scale = element('span', { class: `scale ${this.quantity.name === 'lyapunov_max' ? 'diverging' : ''}` });
      this.legendHost.replaceChildren(
        element(
          'p',
          { class: 'legend' },
          number(factor * low, 4),
          scale,
          `${number(factor * high, 4)}  ${axisLabel(this.quantity)}`,
        ),
      );
    }
    this.panel.redraw();
  }
}

/// Half a cell beyond the first and the last.
function edges(values) {
  if (values.length < 2) return [values[0] - 0.5, values[0] + 0.5];
  const half = (0.5 * (values[values.length - 1] - values[0])) / (values.length - 1);
  return [values[0] - half, values[values.length - 1] + half];
}

const counted = (cells) => `${cells} ${cells === 1 ? 'cell' : 'cells'}`;
