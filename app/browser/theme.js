// Colours of the figures, for light and dark pages. Those of regimes are the program's, distinct for colour-blind eyes
// and in grey; on a dark page the dark ones are lighter.

const light = {
  ink: '#202020',
  faint: '#6b6b6b',
  grid: '#e4e4e0',
  paper: '#ffffff',
  mark: '#111111',
  select: 'rgba(18,40,92,0.12)',
  classes: ['#12285c', '#3f8fd0', '#1b8a6b', '#c8553d', '#8a8a8a', '#b07a00'],
  series: [
    '#12285c',
    '#c8553d',
    '#1b8a6b',
    '#b07a00',
    '#7a4a8c',
    '#4a4a4a',
    '#3f8fd0',
    '#e08fb0',
    '#6fb25a',
    '#8a5a2b',
  ],
  scale: ['#edf8b1', '#c7e9b4', '#7fcdbb', '#41b6c4', '#1d91c0', '#225ea8', '#0c2c84', '#041040'],
  diverging: ['#053061', '#4393c3', '#d1e5f0', '#ffffff', '#fddbc7', '#d6604d', '#67001f'],
  empty: '#9a9a9a',
};
const dark = {
  ...light,
  ink: '#e6e6e3',
  faint: '#a0a09c',
  grid: '#33363b',
  paper: '#17191c',
  mark: '#ffffff',
  select: 'rgba(160,190,255,0.18)',
  classes: ['#8fb0f5', '#4fb3ff', '#3fc79d', '#f0836a', '#a6a6a6', '#e0ab3a'],
  series: [
    '#8fb0f5',
    '#f0836a',
    '#3fc79d',
    '#e0ab3a',
    '#c39ad6',
    '#c9c9c9',
    '#4fb3ff',
    '#f0b3cb',
    '#93d67e',
    '#cda277',
  ],
  empty: '#55585d',
};

const wantsDark = matchMedia('(prefers-color-scheme: dark)');
let printing = false;
const listeners = [];

export const theme = () => (wantsDark.matches && !printing ? dark : light);

/// Called after a change of the colours.
export function onTheme(listener) {
  listeners.push(listener);
}
const changed = () => listeners.forEach((listener) => listener());
wantsDark.addEventListener('change', changed);
for (const [event, value] of [
  ['beforeprint', true],
  ['afterprint', false],
])
  addEventListener(event, () => {
    printing = value;
    changed();
  });

/// [r, g, b] of "#rrggbb".
export const rgb = (colour) => [1, 3, 5].map((k) => parseInt(colour.slice(k, k + 2), 16));

/// The colour at a part of a scale from 0 to 1.
export function shade(scale, part) {
  const place = Math.min(1, Math.max(0, part)) * (scale.length - 1);
  const k = Math.min(scale.length - 2, Math.floor(place));
  const [a, b] = [rgb(scale[k]), rgb(scale[k + 1])];
  return a.map((value, i) => Math.round(value + (place - k) * (b[i] - value)));
}
