// Natural modes of a stage, animated: sun, planets, ring and carrier as circles and arms, displaced by a shape.
import { onTheme, theme } from './theme.js';
import { element, number, rich } from './words.js';

const largest = 0.22; // displacement that is drawn, in centre distances
const seconds = 1.6; // of a period

/// The shapes of the modes by name of coordinate; of several at one frequency the one in which a central member, or any
/// coordinate, has its largest amplitude.
function shapesOf(study) {
  const modes = study.table('modes.csv');
  const shapes = study.table('mode_shapes.csv');
  const names = shapes.columns.map(({ name }) => name).filter((name) => name !== 'mode' && name !== 'shape');
  return Array.from({ length: modes.rows }, (_, row) => {
    const mode = modes.numbers('mode')[row];
    const rows = Array.from(shapes.numbers('mode')).flatMap((of, k) => (of === mode ? [k] : []));
    const type = modes.word('type', row);
    const leading = type === 'translational' ? ['x_s', 'x_r', 'x_c'] : names;
    const norm = (name) => Math.hypot(...rows.map((k) => shapes.numbers(name)[k]));
    const most = Math.max(...leading.map(norm));
    const lead = leading.find((name) => norm(name) >= 0.999 * most);
    const weights = rows.map((k) => (most > 0 ? shapes.numbers(lead)[k] / norm(lead) : 1));
    const amplitude = new Map(
      names.map((name) => [name, rows.reduce((sum, k, j) => sum + weights[j] * shapes.numbers(name)[k], 0)]),
    );
    const size = Math.max(...[...amplitude.values()].map(Math.abs)) || 1;
    const multiple = modes.numbers('multiplicity')[row];
    const frequency = modes.numbers('frequency_Hz')[row];
    return {
      at: (name) => (largest * (amplitude.get(name) ?? 0)) / size,
      label:
        frequency > 0
          ? `Mode ${mode}: ${type}${multiple > 1 ? ` ×${multiple}` : ''}, ${number(frequency, 5)} Hz, ${number(modes.numbers('frequency_ratio')[row], 4)} ω_sn`
          : `Mode ${mode}: ${type}, rigid-body mode`,
      frequency,
    };
  });
}

export const hasModes = (study) =>
  Boolean(study.drawing && study.table('modes.csv')?.rows > 0 && study.table('mode_shapes.csv')?.rows > 0);

export function modesFigure(study) {
  const shapes = shapesOf(study);
  const { sun, planet, ring, angles_deg: degrees } = study.drawing;
  const angles = degrees.map((angle) => (angle * Math.PI) / 180);
  const sunRadius = sun / (sun + planet); // operating pitch circles touch
  const canvas = element('canvas', { role: 'img' });
  const choice = element(
    'select',
    { 'aria-label': 'Mode', onchange: () => (choose(), draw()) },
    shapes.map(({ label }) => element('option', { text: label })),
  );
  let shown = shapes[0];
  let playing = !matchMedia('(prefers-reduced-motion: reduce)').matches;
  let phase = Math.PI / 2; // of a still picture: the largest displacement
  let last = null;
  const button = element('button', { type: 'button', onclick: () => play(!playing) });
  const caption = element('figcaption');

  const choose = () => {
    shown = shapes[choice.selectedIndex];
    canvas.setAttribute('aria-label', shown.label);
  };

  function draw() {
    const ratio = devicePixelRatio || 1;
    const side = Math.max(200, Math.min(420, canvas.parentNode?.clientWidth || 300));
    if (canvas.width !== Math.round(side * ratio)) {
      canvas.width = canvas.height = Math.round(side * ratio);
      canvas.style.width = canvas.style.height = `${side}px`;
    }
    const context = canvas.getContext('2d');
    const unit = canvas.width / (2 * (2 - sunRadius) + 2.6 * largest);
    context.setTransform(unit, 0, 0, -unit, canvas.width / 2, canvas.height / 2);
    context.clearRect(-9, -9, 18, 18);
    const factor = Math.sin(phase);
    const colours = theme();
    const line = (colour, width, path) => {
      context.strokeStyle = colour;
      context.lineWidth = (width * ratio) / unit;
      context.beginPath();
      path();
      context.stroke();
    };
    const circle = (x, y, radius) => (context.moveTo(x + radius, y), context.arc(x, y, radius, 0, 2 * Math.PI));
    const mark = (x, y, from, to, angle) => {
      context.moveTo(x + from * Math.cos(angle), y + from * Math.sin(angle));
      context.lineTo(x + to * Math.cos(angle), y + to * Math.sin(angle));
    };
    const member = (colour, x, y, radius, towards, names, base, inner) => {
      const [dx, dy, turned] = names.map((name, k) => (factor * shown.at(name)) / (k === 2 ? base : 1));
      line(colours.empty, 1, () => (circle(x, y, radius), mark(x, y, inner, radius, towards)));
      line(colour, 2, () => (circle(x + dx, y + dy, radius), mark(x + dx, y + dy, inner, radius, towards + turned)));
    };
    const carrier = (scale, colour, width) =>
      line(colour, width, () =>
        angles.forEach((angle) =>
          mark(scale * shown.at('x_c'), scale * shown.at('y_c'), 0, 1, angle + scale * shown.at('u_c')),
        ),
      );
    carrier(0, colours.empty, 1);
    carrier(factor, colours.series[3], 3);
    const ringRadius = 2 - sunRadius;
    member(colours.series[2], 0, 0, ringRadius, Math.PI / 2, ['x_r', 'y_r', 'u_r'], ring, 0.9 * ringRadius);
    angles.forEach((angle, i) =>
      member(
        colours.series[1],
        Math.cos(angle),
        Math.sin(angle),
        1 - sunRadius,
        angle,
        [`x_p${i + 1}`, `y_p${i + 1}`, `u_p${i + 1}`],
        planet,
        0,
      ),
    );
    member(colours.series[0], 0, 0, sunRadius, Math.PI / 2, ['x_s', 'y_s', 'u_s'], sun, 0);
  }

  function frame(now) {
    if (!playing || !canvas.isConnected) return (last = null);
    if (last !== null) phase += (2 * Math.PI * Math.min(0.1, (now - last) / 1000)) / seconds;
    last = now;
    draw();
    requestAnimationFrame(frame);
  }

  function play(on) {
    playing = on;
    button.textContent = on ? 'Pause' : 'Play';
    button.setAttribute('aria-pressed', String(on));
    if (on) requestAnimationFrame(frame);
    else ((phase = Math.PI / 2), draw());
  }

  caption.append(
    rich(
      'Natural modes of the linear stage. Displacements are enlarged, and their frequency is not to scale. The marks show rotations, which count as displacements of the base circles; grey is at rest.',
    ),
  );
  const key = ['sun', 'planets', 'ring', 'carrier'].map((name, k) =>
    element('li', {}, element('span', { class: `swatch series${k}` }), name),
  );
  const host = element(
    'figure',
    { class: 'small modes' },
    canvas,
    element('ul', { class: 'legend' }, key),
    caption,
    element('div', { class: 'choosers' }, choice, button),
  );
  // The first mode that is no rigid rotation.
  choice.selectedIndex = Math.max(
    0,
    shapes.findIndex(({ frequency }) => frequency > 0),
  );
  choose();
  onTheme(() => canvas.isConnected && draw());
  requestAnimationFrame(() => (draw(), play(playing)));
  return host;
}
