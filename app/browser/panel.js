// A panel: axes by uPlot, everything between them drawn by its owner; zoom, pan, hover, click.
/* global uPlot */
import { theme, onTheme, rgb } from './theme.js';
import { element, number, superscript } from './words.js';

const finite = (range) => range && Number.isFinite(range[0]) && Number.isFinite(range[1]) && range[0] < range[1];

/// [low, high] of numbers, with a margin; something of no numbers, or of one.
export function rangeOf(low, high, margin) {
  if (!(low <= high)) return [0, 1];
  const wide = high - low || Math.abs(high) || 1;
  return [low - margin * wide, high + margin * wide];
}

/// Values on a logarithmic axis that are labelled: powers of ten; over less than three decades 2 and 5 times them, too;
/// over less than one all digits; of a narrower range everything.
function isLabelled(value, [low, high]) {
  const mantissa = Number(value.toExponential(6).split('e')[0]);
  if (high < 2 * low) return true;
  if (high < 10 * low) return Number.isInteger(mantissa);
  return mantissa === 1 || (high < 1000 * low && (mantissa === 2 || mantissa === 5));
}

/// A tick of a logarithmic axis: 10⁻⁵, but 0.01.
function powerText(value) {
  const [mantissa, exponent] = value.toExponential(6).split('e').map(Number);
  return mantissa === 1 && Math.abs(exponent) > 2 ? `10${superscript(exponent)}` : number(value, 4);
}

/// Values of a logarithmic axis with a tick: whole multiples of powers of ten. (Those of uPlot never end for some ranges
/// that do not begin at one.)
function logarithmicSplits(low, high) {
  const splits = [];
  if (high < 2 * low) {
    const least = (high - low) / 8;
    const power = 10 ** Math.floor(Math.log10(least));
    const step = power * ([1, 2, 5].find((digit) => digit * power >= least) ?? 10);
    for (let k = Math.ceil(low / step); k * step <= high; ++k) splits.push(k * step);
    return splits;
  }
  for (let power = Math.floor(Math.log10(low)); 10 ** power <= high; ++power)
    for (let digit = 1; digit < 10; ++digit) {
      const value = Number(`${digit}e${power}`);
      if (value >= low && value <= high) splits.push(value);
    }
  return splits;
}

/// The row of values that is nearest to the cursor, at most 20 pixels away; null: none is.
export function nearestRow({ left, top, ...place }, xs, ys) {
  let best = null;
  for (let row = 0; row < xs.length; ++row) {
    const dx = (place.x(xs[row]) - place.leftOfPlot) / place.ratio - left;
    const dy = (place.y(ys[row]) - place.topOfPlot) / place.ratio - top;
    const apart = dx * dx + dy * dy;
    if (apart < 400 && (!best || apart < best.apart)) best = { apart, row };
  }
  return best?.row ?? null;
}

const all = new Set();
let wheelExplained = false; // once, and not beside each figure
onTheme(() => all.forEach((panel) => panel.build()));

/// Gives up the panels that are not on the page any more.
export function releasePanels() {
  for (const panel of all) if (!panel.node.isConnected) panel.release();
}

/// A view of the abscissa that panels share.
export class View {
  constructor(full) {
    this.full = full;
    this.x = [...full];
    this.panels = [];
  }

  show(x) {
    if (!finite(x)) return;
    const wide = Math.max(x[1] - x[0], 1e-9 * (Math.abs(x[0]) + Math.abs(x[1]) || 1));
    // There is nothing beyond the whole range.
    const [low, high] = this.full;
    const from = Math.max(low, Math.min(x[0], high - wide));
    this.x = wide < high - low ? [from, from + wide] : [low, high];
    for (const panel of this.panels) panel.redraw();
  }

  /// @param at  stays where it is
  zoom(factor, at = 0.5 * (this.x[0] + this.x[1])) {
    this.show([at + (this.x[0] - at) * factor, at + (this.x[1] - at) * factor]);
  }

  pan(part) {
    const step = part * (this.x[1] - this.x[0]);
    this.show([this.x[0] + step, this.x[1] + step]);
  }

  reset() {
    for (const panel of this.panels) panel.y = null;
    this.show([...this.full]);
  }
}

export class Panel {
  /// @param options  host, view, height, xLabel(), yLabel(), range(x): that of the ordinate, draw(context, place, panel),
  ///                 hover(place): the text of what is there and whatever pick() takes, pick(found), at(x): what is picked
  ///                 where nothing is found, xAxis, logarithmic,
  ///                 region([from, to]) of the abscissa: a drag with Ctrl
  constructor(options) {
    this.options = options;
    this.view = options.view;
    this.y = null; // the owner's range
    this.node = element('div', { class: 'panel' });
    this.tip = element('div', { class: 'tip', hidden: true });
    this.node.append(this.tip);
    options.host.append(this.node);
    this.view.panels.push(this);
    this.build();
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(this.node);
    all.add(this);
  }

  release() {
    all.delete(this);
    this.observer.disconnect();
    this.plot.destroy();
  }

  build() {
    this.plot?.destroy();
    const colours = theme();
    const axis = (label, size, logarithmic) => ({
      label,
      labelSize: 18,
      size,
      stroke: colours.ink,
      font: '12px system-ui, sans-serif',
      labelFont: '13px system-ui, sans-serif',
      values: (plot, splits) => {
        const { min, max } = plot.scales.y;
        const none = (value) =>
          value === null || value === undefined || (logarithmic && !isLabelled(value, [min, max]));
        return splits.map((value) => (none(value) ? '' : logarithmic ? powerText(value) : number(value, 12)));
      },
      ...(logarithmic ? { splits: (_plot, _axis, low, high) => logarithmicSplits(low, high) } : {}),
      grid: { stroke: colours.grid, width: 1 },
      ticks: { stroke: colours.grid, width: 1, size: 5 },
    });
    const { options } = this;
    this.plot = new uPlot(
      {
        width: Math.max(200, this.node.clientWidth || 600),
        height: options.height(),
        padding: [8, 14, 0, 0],
        legend: { show: false },
        pxAlign: 0,
        scales: {
          x: { time: false, range: (_, low, high) => [low, high] },
          y: { range: (_, low, high) => [low, high], distr: options.logarithmic?.() ? 3 : 1 },
        },
        axes: [
          options.xAxis === false ? { ...axis(undefined, 22), labelSize: 0 } : axis(options.xLabel(), 32),
          axis(options.yLabel(), 58, options.logarithmic?.()),
        ],
        series: [{}, { paths: () => null, points: { show: false } }],
        cursor: {
          drag: { x: true, y: true, uni: 24, setScale: false },
          points: { show: false },
          bind: { dblclick: () => () => (this.view.reset(), null) },
          ...(options.sync ? { sync: { key: options.sync, setSeries: false, scales: ['x', null] } } : {}),
        },
        hooks: {
          draw: [(plot) => this.draw(plot)],
          setSelect: [(plot) => this.selected(plot)],
          setCursor: [(plot) => this.hover(plot)],
        },
      },
      [this.view.x, this.yRange()],
      this.node,
    );
    this.listen(this.plot.over);
    this.redraw();
  }

  resize() {
    const width = this.node.clientWidth;
    if (width > 0 && (width !== this.plot.width || this.options.height() !== this.plot.height))
      this.plot.setSize({ width, height: this.options.height() });
  }

  yRange() {
    const range = this.y ?? this.options.range(this.view.x);
    if (this.options.logarithmic?.()) return finite(range) && range[0] > 0 ? range : [0.1, 1];
    return finite(range) ? range : [0, 1];
  }

  redraw() {
    const [low, high] = this.yRange();
    this.plot.batch(() => {
      this.plot.setScale('x', { min: this.view.x[0], max: this.view.x[1] });
      this.plot.setScale('y', { min: low, max: high });
    });
    this.plot.redraw(false, true);
  }

  /// Labels of axes and kind of scale are read once.
  relabel() {
    this.y = null;
    this.build();
  }

  /// Where values are on the canvas, and the canvas' own measures.
  place(plot = this.plot) {
    const { left, top, width, height } = plot.bbox;
    return {
      left,
      top,
      width,
      height,
      leftOfPlot: left,
      topOfPlot: top,
      ratio: devicePixelRatio || 1,
      x: (value) => plot.valToPos(value, 'x', true),
      y: (value) => plot.valToPos(value, 'y', true),
      xAt: (pixel) => plot.posToVal(pixel, 'x'),
      yAt: (pixel) => plot.posToVal(pixel, 'y'),
      xRange: [plot.scales.x.min, plot.scales.x.max],
      yRange: [plot.scales.y.min, plot.scales.y.max],
      logarithmic: plot.scales.y.distr === 3,
    };
  }

  draw(plot) {
    if (!Number.isFinite(plot.scales.x.min) || !Number.isFinite(plot.scales.y.min)) return;
    const place = this.place(plot);
    const { ctx } = plot;
    ctx.save();
    ctx.beginPath();
    ctx.rect(place.left, place.top, place.width, place.height);
    ctx.clip();
    this.options.draw(ctx, place, this);
    ctx.restore();
    ctx.save();
    ctx.strokeStyle = theme().faint;
    ctx.lineWidth = place.ratio;
    ctx.strokeRect(place.left, place.top, place.width, place.height);
    ctx.restore();
  }

  selected(plot) {
    const { left, top, width, height } = plot.select;
    // Panels with the same abscissa select what is selected in one of them: only that one zooms.
    const own = this.pressed;
    this.pressed = false;
    if (!own) return plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    if (width < 4 && height < 4) return;
    this.dragged = true;
    const before = this.y;
    const x = [plot.posToVal(left, 'x'), plot.posToVal(left + width, 'x')];
    if (height > 4 && height < plot.over.clientHeight - 1)
      this.y = [plot.posToVal(top + height, 'y'), plot.posToVal(top, 'y')];
    plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    if (this.options.region && this.withControl && width > 4) {
      this.y = before;
      this.redraw();
      this.options.region(x);
      return;
    }
    if (width > 4 && width < plot.over.clientWidth - 1) this.view.show(x);
    else this.redraw();
  }

  hover(plot) {
    const { left, top } = plot.cursor;
    const inside = left >= 0 && top >= 0 && plot.over.matches(':hover');
    const found = inside ? this.options.hover?.({ ...this.place(plot), left, top }) : null;
    this.found = found;
    this.tip.hidden = !found;
    if (!found) return;
    this.tip.textContent = found.text;
    const over = plot.over.getBoundingClientRect();
    const box = this.node.getBoundingClientRect();
    const x = over.left - box.left + left;
    const right = x > 0.55 * box.width;
    this.tip.style.left = right ? 'auto' : `${x + 14}px`;
    this.tip.style.right = right ? `${box.width - x + 14}px` : 'auto';
    this.tip.style.top = `${over.top - box.top + Math.max(0, top - 10)}px`;
  }

  explainWheel() {
    if (wheelExplained) return;
    wheelExplained = true;
    const hint = element('div', { class: 'wheel', role: 'status', text: 'Ctrl and the wheel zoom (on a Mac: ⌘)' });
    this.node.append(hint);
    setTimeout(() => hint.remove(), 2500);
  }

  /// What was found at the cursor, or what the owner has at this abscissa.
  pickAt(found, left = this.plot.cursor.left) {
    const picked = found ?? this.options.at?.(this.plot.posToVal(left, 'x'));
    if (picked) this.options.pick?.(picked);
  }

  listen(over) {
    let from = null; // of a pan
    const fingers = new Map();
    let pinched = null; // values under two fingers
    const places = () => [...fingers.values()].sort((a, b) => a - b);
    over.addEventListener('click', () => {
      if (!this.dragged) this.pickAt(this.found);
      this.dragged = false;
    });
    over.addEventListener(
      'wheel',
      (event) => {
        // A wheel alone scrolls the page.
        if (!(event.ctrlKey || event.metaKey || event.altKey || event.shiftKey)) return this.explainWheel();
        event.preventDefault();
        const box = over.getBoundingClientRect();
        const factor = Math.exp(0.0015 * Math.max(-400, Math.min(400, event.deltaY)));
        if (event.altKey) {
          const at = this.plot.posToVal(event.clientY - box.top, 'y');
          this.y = this.yRange().map((value) => at + (value - at) * factor);
          this.redraw();
        } else if (event.shiftKey) {
          this.view.pan(0.001 * (event.deltaX || event.deltaY));
        } else {
          this.view.zoom(factor, this.plot.posToVal(event.clientX - box.left, 'x'));
        }
      },
      { passive: false },
    );
    // Pan: shift or the middle button and drag; on a touch screen one finger.
    const begin = (event) => {
      // A click after a drag is kept from us by the axes.
      if (fingers.size === 0) this.dragged = false;
      if (!(event.pointerType === 'touch' || event.shiftKey || event.button === 1)) return;
      if (event.pointerType === 'touch')
        fingers.set(event.pointerId, event.clientX - over.getBoundingClientRect().left);
      from = { at: event.clientX, x: [...this.view.x] };
      if (fingers.size === 2) {
        pinched = places().map((at) => this.plot.posToVal(at, 'x'));
        from = null;
        this.dragged = true;
      }
      over.setPointerCapture(event.pointerId);
    };
    over.addEventListener('pointerdown', begin);
    over.addEventListener(
      'mousedown',
      (event) => {
        this.pressed = true;
        this.withControl = event.ctrlKey || event.metaKey;
        if (event.shiftKey || event.button === 1) (event.stopImmediatePropagation(), event.preventDefault());
      },
      true,
    );
    over.addEventListener('pointermove', (event) => {
      if (fingers.has(event.pointerId)) fingers.set(event.pointerId, event.clientX - over.getBoundingClientRect().left);
      if (pinched && fingers.size === 2) {
        // The values stay under the fingers.
        const [left, right] = places();
        if (right - left < 12) return;
        const perPixel = (pinched[1] - pinched[0]) / (right - left);
        const low = pinched[0] - left * perPixel;
        this.view.show([low, low + over.clientWidth * perPixel]);
        return;
      }
      if (!from) return;
      const step = ((from.at - event.clientX) / over.clientWidth) * (from.x[1] - from.x[0]);
      if (Math.abs(from.at - event.clientX) > 3) this.dragged = true;
      this.view.show(from.x.map((value) => value + step));
    });
    for (const end of ['pointerup', 'pointercancel'])
      over.addEventListener(end, (event) => {
        fingers.delete(event.pointerId);
        if (fingers.size < 2) pinched = null;
        if (from && event.pointerType === 'touch' && !this.dragged) {
          const box = over.getBoundingClientRect();
          const found = this.options.hover?.({
            ...this.place(),
            left: event.clientX - box.left,
            top: event.clientY - box.top,
          });
          this.pickAt(found, event.clientX - box.left);
          this.dragged = true; // The click that follows picks nothing else.
        }
        from = null;
      });
  }
}

/// Points in numbers: each pixel is the darker the more points fall on it.
export class Raster {
  constructor(place) {
    this.place = place;
    this.width = Math.max(1, Math.round(place.width));
    this.height = Math.max(1, Math.round(place.height));
    this.count = new Uint16Array(this.width * this.height);
    this.of = new Uint8Array(this.width * this.height);
    const [x0, x1] = place.xRange;
    const [y0, y1] = place.logarithmic ? place.yRange.map(Math.log10) : place.yRange;
    this.x0 = x0;
    this.y0 = y0;
    this.perX = this.width / (x1 - x0);
    this.perY = this.height / (y1 - y0);
    this.drawn = 0;
  }

  add(x, y, colour) {
    const column = ((x - this.x0) * this.perX) | 0;
    const row = ((this.place.logarithmic ? Math.log10(y) : y) - this.y0) * this.perY;
    if (!(row >= 0) || row >= this.height || column < 0 || column >= this.width) return;
    const at = (this.height - 1 - (row | 0)) * this.width + column;
    if (this.count[at] < 65535) ++this.count[at];
    this.of[at] = colour;
    ++this.drawn;
  }

  /// Makes the image of what was added.
  /// @param colours  "#rrggbb" of each
  render(colours) {
    let places = 0;
    for (const n of this.count) if (n > 0) ++places;
    const size = Math.max(1, Math.round((places < 4000 ? 2.6 : 1.6) * this.place.ratio));
    const image = new ImageData(this.width, this.height);
    const parts = colours.map(rgb);
    const { width, height, count, of } = this;
    const half = size >> 1;
    for (let at = 0; at < count.length; ++at) {
      if (count[at] === 0) continue;
      const alpha = Math.min(255, 150 + 35 * count[at]);
      const [r, g, b] = parts[of[at]];
      const row = (at / width) | 0;
      const column = at - row * width;
      for (let i = Math.max(0, row - half); i < Math.min(height, row - half + size); ++i)
        for (let j = Math.max(0, column - half); j < Math.min(width, column - half + size); ++j) {
          const byte = 4 * (i * width + j);
          if (image.data[byte + 3] >= alpha) continue;
          image.data[byte] = r;
          image.data[byte + 1] = g;
          image.data[byte + 2] = b;
          image.data[byte + 3] = alpha;
        }
    }
    this.canvas = new OffscreenCanvas(width, height);
    this.canvas.getContext('2d').putImageData(image, 0, 0);
    this.count = this.of = null;
  }

  paint(context) {
    context.drawImage(this.canvas, Math.round(this.place.left), Math.round(this.place.top));
  }
}

/// A line through values; a gap where one is not finite.
export function strokeLine(context, place, xs, ys, { colour, width = 1.4, dash = [] }) {
  context.save();
  context.strokeStyle = colour;
  context.lineWidth = width * place.ratio;
  context.setLineDash(dash.map((length) => length * place.ratio));
  context.beginPath();
  let open = false;
  for (let i = 0; i < xs.length; ++i) {
    if (!Number.isFinite(xs[i]) || !Number.isFinite(ys[i])) {
      open = false;
      continue;
    }
    if (open) context.lineTo(place.x(xs[i]), place.y(ys[i]));
    else context.moveTo(place.x(xs[i]), place.y(ys[i]));
    open = true;
  }
  context.stroke();
  context.restore();
}

export function dot(context, x, y, radius, colour, ring) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  if (colour) {
    context.fillStyle = colour;
    context.fill();
  }
  if (ring) {
    context.strokeStyle = ring;
    context.lineWidth = Math.max(1, 0.3 * radius);
    context.stroke();
  }
}
