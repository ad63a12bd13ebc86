// node report.mjs CHROMIUM FOLDER
//
// Opens the reports in FOLDER (sweep.html, both.html, torus.html, map.html, basins.html, run.html, gear.html,
// ramp.html, unfinished.html, hostile.html) as a reader would: no error, no request, zoom, hover, click, keys, dark, a
// narrow screen, a PDF.
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';
import { join } from 'node:path';
import { Browser, Checks } from './browser.mjs';

const [, , program, folder] = process.argv;
const checks = new Checks();
const { expect, clean } = checks;

const browser = new Browser(program);
const open = (name, options) => browser.open(pathToFileURL(join(folder, name)).href, options);

/// Where the first panel is, and the values at its ends as its tick labels are drawn on a canvas: read from a hover.
const over = (page, k = 0) =>
  page.value(
    `(() => { const box = document.querySelectorAll('.u-over')[${k}].getBoundingClientRect(); return [box.left, box.top, box.width, box.height]; })()`,
  );
const tip = (page) =>
  page.value(
    "[...document.querySelectorAll('.tip')].filter((tip) => !tip.hidden).map((tip) => tip.textContent).join('')",
  );
const details = (page) => page.value("document.querySelector('.details').textContent");
/// Pixels of the first panel that are not those of another picture of it.
const picture = (page) =>
  page.value(
    "document.querySelector('.panel canvas').toDataURL().length + ':' + [...document.querySelector('.panel canvas').toDataURL()].reduce((sum, c) => (sum * 31 + c.charCodeAt(0)) >>> 0, 7)",
  );
const chosenValue = async (page) => Number((/= ([0-9.]+)/.exec(await details(page)) ?? [])[1]);

/// Where points are drawn in the first panel, in colours of regimes: one place in each 40 pixels of the abscissa.
const drawnPlaces = (page) =>
  page.value(`(() => {
    const canvas = document.querySelector('.panel canvas');
    const [own, over] = [canvas, document.querySelector('.u-over')].map((node) => node.getBoundingClientRect());
    const margin = 20;
    const [width, height] = [over.width - 2 * margin, over.height - 2 * margin].map(Math.floor);
    const copy = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
    copy.drawImage(canvas, own.left - over.left - margin, own.top - over.top - margin);
    const { data } = copy.getImageData(0, 0, width, height);
    const names = ['--class0', '--class1', '--class2', '--class3', '--class4', '--class5'];
    const colours = names.map((name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim());
    const wanted = colours.map((text) => [1, 3, 5].map((k) => parseInt(text.slice(k, k + 2), 16)));
    const found = new Map();
    for (let at = 0; at < width * height; ++at) {
      const [x, y] = [at % width, Math.floor(at / width)];
      if (wanted.some((rgb) => rgb.every((value, k) => Math.abs(data[4 * at + k] - value) < 3)) && !found.has(Math.floor(x / 40)))
        found.set(Math.floor(x / 40), [x + over.left + margin, y + over.top + margin]);
    }
    return [...found.values()];
  })()`);

await checks.run(browser, async () => {
  {
    const page = await open('sweep.html');
    expect((await page.value('document.body.dataset.state')) === 'ready', 'the sweep is not shown');
    expect((await page.value("document.querySelectorAll('.panel').length")) >= 2, 'panels of the sweep');
    const all = await picture(page);

    // Keys: a point is chosen, the next one is further along the axis.
    await page.value("document.querySelector('.figure').focus()");
    await page.key('ArrowRight');
    const first = await chosenValue(page);
    expect(Number.isFinite(first), `no point by a key: ${(await details(page)).slice(0, 200)}`);
    await page.key('ArrowRight');
    expect((await chosenValue(page)) > first, 'the next point is not further');
    await page.key('ArrowLeft');
    expect((await chosenValue(page)) === first, 'back to the point');
    const direction = /Point \d+, (up|down)/.exec(await details(page))?.[1];
    await page.key('ArrowDown');
    expect(/Point \d+, (up|down)/.exec(await details(page))?.[1] !== direction, 'the other direction');
    for (const word of [
      'Regime',
      'Evidence',
      'Poincaré section',
      'Amplitude spectrum',
      'Time history',
      'Meshes of the sun',
      'epicyclic run --from',
    ])
      expect((await details(page)).includes(word), `the chosen point has no ${word}`);
    const chosen = await picture(page);
    const said = await page.value("document.querySelector('.details [role=status]').textContent");
    expect(/^Point \d+, (up|down)\. Ω = /.test(said), `a screen reader says '${said}'`);
    const [left, top, width, height] = await over(page);

    // Zoom by keys, by a drag and by the wheel, and all of it again.
    await page.key('+', '+');
    const zoomed = await picture(page);
    expect(zoomed !== chosen, 'the key + does not zoom');
    await page.key('0', '0');
    expect((await picture(page)) === chosen, 'the key 0 does not show all');
    await page.drag([left + 0.3 * width, top + 0.5 * height], [left + 0.6 * width, top + 0.5 * height]);
    const dragged = await picture(page);
    expect(dragged !== chosen, 'a drag does not zoom');
    // 0.3 to 0.6 of the range have two values of Ω: a drag zooms once, and not once for each panel.
    const columns = await drawnPlaces(page);
    expect(columns.length >= 2 && columns.length <= 6, `after the drag points are drawn in ${columns.length} places`);
    // The first click after it chooses.
    await page.click(...columns[0]);
    const clicked = await chosenValue(page);
    expect(clicked > 2.15 && clicked < 2.23, `a click after the drag chooses ${clicked}`);
    await page.click(left + 0.1 * width, top + 0.97 * height, 2);
    expect((await picture(page)) !== dragged, 'a double click does not show all');
    await page.key('0', '0');
    // The wheel alone scrolls the page, and a hint says so once; with Ctrl it zooms.
    const still = await picture(page);
    await page.wheel(left + 0.5 * width, top + 0.5 * height, 60);
    await page.until('scrollY > 0');
    expect((await picture(page)) === still, 'the wheel alone zooms');
    const hints = "document.querySelectorAll('.wheel').length";
    expect((await page.value(hints)) === 1, 'no hint about the wheel');
    await page.until(`${hints} === 0`);
    await page.wheel(left + 0.5 * width, top + 0.5 * height - 60, -600);
    await page.until('scrollY === 0');
    expect((await page.value(hints)) === 0, 'the hint about the wheel again');
    await page.wheel(left + 0.5 * width, top + 0.5 * height, -300, 2);
    await page.frame();
    expect((await picture(page)) !== still, 'the wheel with Ctrl does not zoom');
    expect((await page.value('scrollY')) === 0, 'the wheel with Ctrl scrolls');
    await page.key('0', '0');

    // Hover over the point that was chosen, and click.
    const place = (await drawnPlaces(page))[0] ?? null;
    expect(place !== null, 'no point is drawn in the colour of a regime');
    if (place) {
      await page.mouse('mouseMoved', place[0] - 1, place[1]);
      await page.mouse('mouseMoved', ...place);
      await page.frame();
      const hovered = await tip(page);
      expect(/δ_sp,1 = /.test(hovered) && /Ω = /.test(hovered), `hover shows '${hovered}'`);
      await page.click(...place);
      const at = /Ω = ([0-9.]+)/.exec(hovered)?.[1];
      expect(
        Math.abs((await chosenValue(page)) - Number(at)) < 1e-4,
        `a click chooses ${await chosenValue(page)} and not ${at}`,
      );
    }

    // A click beside all points chooses the nearest value; there is nothing beyond the whole range.
    await page.click(left + width - 3, top + 3);
    const last = await chosenValue(page);
    expect(last > Math.max(clicked, 2.2), `a click in the corner chooses ${last}`);
    const whole = await picture(page);
    await page.key('-', '-');
    expect((await picture(page)) === whole, 'zooming out shows more than the whole range');
    // A point of the Poincaré section has a reading. The only point of period 1 is in the middle.
    const section = await page.value(
      "(() => { const box = document.querySelector('.details .u-over').getBoundingClientRect(); return [box.left + box.width / 2, box.top + box.height / 2]; })()",
    );
    await page.mouse('mouseMoved', section[0] - 2, section[1]);
    await page.mouse('mouseMoved', ...section);
    await page.frame();
    const reading = await tip(page);
    expect(/delta_sp_1 = /.test(reading), `hover over the section shows '${reading}'`);

    // Other quantities, abscissae and units.
    const before = await picture(page);
    await page.value(
      "(() => { const choice = document.querySelector('#quantity'); choice.value = 'curve:delta_sp_rms'; choice.dispatchEvent(new Event('change')); })()",
    );
    await page.frame();
    expect((await picture(page)) !== before, 'another quantity is the same picture');
    const listed = "[...document.querySelectorAll('#quantity option')].map((option) => option.value)";
    const names = await page.value(listed);
    expect(names.includes('section:delta_rp_1') && names.includes('curve:kv_sp'), 'quantities to choose from');
    expect(new Set(names).size === names.length, 'a quantity is listed twice');
    // In groups, the most used first; a filter by all its words.
    const groups = await page.value("[...document.querySelectorAll('#quantity optgroup')].map(({ label }) => label)");
    for (const group of ['Most used', 'Deflections', 'Forces, each planet', 'Regime and its evidence', 'Counts'])
      expect(groups.includes(group), `no group ${group} in ${groups}`);
    expect(groups[0] === 'Poincaré points' && groups[1] === 'Most used', `the first groups are ${groups}`);
    expect(!groups.includes('Others'), 'a quantity is in no group');
    const filter = (text, enter) =>
      page.value(
        `(() => { const filter = document.querySelector('.filter input'); filter.value = '${text}'; filter.dispatchEvent(new Event('input')); if (${enter}) filter.dispatchEvent(new KeyboardEvent('keydown', { key: 'Enter' })); })()`,
      );
    await filter('Ring LARGEST force', false);
    const found = await page.value(listed);
    expect(
      found.includes('curve:force_rp_max') && !found.includes('curve:kv_sp') && found.length < 20,
      `the filter leaves ${found}`,
    );
    await filter('period n', true);
    expect((await page.value("document.querySelector('#quantity').value")) === 'curve:period', 'Enter in the filter');
    await filter('', false);
    expect((await page.value(listed)).length === names.length, 'the empty filter leaves not all');
    await page.value(
      "(() => { for (const select of document.querySelectorAll('.toolbar select')) for (let k = 0; k < select.options.length; ++k) { select.selectedIndex = k; select.dispatchEvent(new Event('change')); } })()",
    );
    await page.frame();
    await page.value("document.querySelectorAll('.study details').forEach((part) => (part.open = true))");
    await page.frame();
    expect(
      await page.value("document.querySelector('table.input').textContent.includes('recorded_periods')"),
      'the input is not listed',
    );
    expect((await page.value("document.querySelectorAll('table.rows tbody tr').length")) > 5, 'the table of points');
    const text = await page.value('document.body.innerText');
    for (const word of ['relative 1e-06', 'commit', 'Identity of the study', '1/65534', 'epicyclic sweep'])
      expect(text.includes(word), `the page does not say '${word}'`);
    clean(page, 'sweep.html');

    const { data } = await page.send('Page.printToPDF', { printBackground: false });
    expect(Buffer.from(data, 'base64').subarray(0, 5).toString() === '%PDF-' && data.length > 20_000, 'no PDF');
    expect(
      (await page.value("getComputedStyle(document.querySelector('.toolbar')).display")) !== 'none',
      'the screen after printing',
    );
  }

  // Dark, and narrow: one column that does not have to be moved sideways.
  {
    const page = await open('sweep.html', { dark: true });
    const colours = await page.value(
      "[document.documentElement, document.querySelector('.figure')].map((node) => getComputedStyle(node).backgroundColor.match(/\\d+/g).slice(0, 3).map(Number))",
    );
    expect(
      colours.flat().every((part) => part < 60),
      `dark: ${JSON.stringify(colours)}`,
    );
    clean(page, 'dark');
  }
  for (const name of ['sweep.html', 'both.html', 'map.html', 'basins.html', 'run.html', 'gear.html', 'ramp.html']) {
    const page = await open(name, { width: 390, height: 844 });
    await page.value("document.querySelector('.figure')?.focus()");
    await page.key('ArrowRight');
    await page.value("document.querySelectorAll('.study > details').forEach((part) => (part.open = true))");
    await page.frame();
    const beyond = await page.value('document.documentElement.scrollWidth - document.documentElement.clientWidth');
    expect(beyond <= 0, `${name} is ${beyond} px too wide for 390 px`);
    clean(page, `${name} at 390 px`);
  }

  // Two fingers zoom.
  {
    const page = await open('sweep.html', { width: 390, height: 844 });
    await page.send('Emulation.setTouchEmulationEnabled', { enabled: true, maxTouchPoints: 2 });
    const before = await picture(page);
    const [left, top, width, height] = await over(page);
    const fingers = (a, b) =>
      [a, b].map((part, id) => ({ x: left + part * width, y: top + 0.5 * height, id, radiusX: 2, radiusY: 2 }));
    await page.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: fingers(0.4, 0.6).slice(0, 1) });
    await page.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: fingers(0.4, 0.6) });
    for (const step of [0.05, 0.1, 0.15])
      await page.send('Input.dispatchTouchEvent', { type: 'touchMove', touchPoints: fingers(0.4 - step, 0.6 + step) });
    await page.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
    await page.frame();
    expect((await picture(page)) !== before, 'two fingers do not zoom');
    clean(page, 'two fingers');
  }

  // Branches over a sweep; cells; one point.
  {
    const page = await open('both.html');
    expect(
      (await page.value("document.querySelectorAll('.figures').length")) === 1,
      'sweep and branches are in one diagram',
    );
    const text = await page.value('document.body.innerText');
    // Changes of the sweep by the special point between their values, and special points; each selects its point.
    const table = (k) =>
      page.value(
        `[...document.querySelectorAll('.list')[${k}].querySelectorAll('tbody tr')].map((row) => [...row.children].map((cell) => cell.textContent))`,
      );
    const changes = await table(0);
    const doubling = changes.filter(([at]) => at === '2.175 to 2.2' || at === '2.2 to 2.175');
    expect(doubling.length === 2, `changes: ${JSON.stringify(changes)}`);
    for (const [, , from, to, type, multiplier] of doubling) {
      expect([from, to].includes('period 1'), `regimes ${from}, ${to}`);
      expect(type === 'period doubling (flip), branch 0', `type ${type}`);
      expect(/^−1\.0\d+ at 2\.175$/.test(multiplier), `multiplier ${multiplier}`);
    }
    await page.value(
      `document.querySelectorAll('.list')[0].querySelectorAll('button.link')[${changes.indexOf(doubling[0])}].click()`,
    );
    expect(
      (await chosenValue(page)) === Number(doubling[0][0].split(' ')[0]),
      `a change selects ${await chosenValue(page)}`,
    );
    const [special] = await table(1);
    expect(special[1] === 'PD: period doubling (flip)' && special[4] === '−1', `special point: ${special}`);
    expect(/^2\.183\d+ ± 0\.0\d+$/.test(special[0]), `special point at ${special[0]}`);
    await page.value("document.querySelectorAll('.list')[1].querySelector('button.link').click()");
    expect((await details(page)).includes('PD: period doubling'), 'a special point is not selected');
    expect(
      text.includes('stable branch') && text.includes('PD: period doubling (flip)'),
      'what branches and special points are',
    );
    expect(text.includes('Results in words (sweep.md)') && text.includes('Windows'), 'the sweep in words');
    // An orbit of the branch: multipliers and a history.
    await page.value("document.querySelector('.figure').focus()");
    for (let k = 0; k < 4 && !(await details(page)).includes('of branch'); ++k) await page.key('ArrowDown');
    for (const word of ['Floquet multipliers and the unit circle', 'Time history of 4 mesh periods', 'Stability'])
      expect((await details(page)).includes(word), `the orbit has no ${word}`);
    clean(page, 'both.html');
  }
  for (const [name, word] of [
    ['map.html', 'Cell '],
    ['basins.html', 'Attractor '],
  ]) {
    const page = await open(name);
    await page.value("document.querySelector('.figure').focus()");
    await page.key('ArrowRight');
    expect((await details(page)).includes(word), `${name}: no ${word}`);
    const [left, top, width, height] = await over(page);
    await page.click(left + 0.5 * width, top + 0.5 * height);
    expect((await details(page)).includes(word) && (await tip(page)).includes(' = '), `${name}: hover and click`);
    clean(page, name);
  }
  {
    const page = await open('run.html');
    const text = await page.value('document.body.innerText');
    expect(
      (await page.value("document.querySelectorAll('.modes canvas').length")) === 1,
      'modes of the stage of a run',
    );
    for (const word of ['Time history', 'Phase portrait', 'Poincaré section', 'The operating point'])
      expect(text.includes(word), `run.html: no ${word}`);
    expect((await page.value("document.querySelectorAll('.panel').length")) >= 3, 'panels of the run');
    // Small amplitudes of a long table are kept.
    await page.value(
      "[...document.querySelectorAll('figure')].find((one) => one.textContent.includes('Amplitude spectrum')).id = 'spectrum'",
    );
    const [at, top, width, height] = await page.value(
      "(() => { const over = document.querySelector('#spectrum .u-over'); over.scrollIntoView(); const box = over.getBoundingClientRect(); return [box.left, box.top, box.width, box.height]; })()",
    );
    await page.mouse('mouseMoved', at + 0.95 * width, top + 0.5 * height);
    await page.frame();
    const line = await page.value("document.querySelector('#spectrum .tip').textContent");
    const [, order, size] = /^frequency ([0-9.]+) ω_m\namplitude ([0-9.]+·10⁻\S+) µm/.exec(line) ?? [];
    expect(order > 18 && size !== undefined, `the spectrum at its end: ${line}`);
    clean(page, 'run.html');
  }
  {
    // Tables of a stage, and any two columns over each other.
    const page = await open('gear.html');
    expect((await page.value("document.querySelectorAll('.panel').length")) >= 5, 'figures of the stage');
    const before = await picture(page);
    await page.value(
      "(() => { const choice = document.querySelectorAll('.choosers select')[1]; choice.selectedIndex = (choice.selectedIndex + 1) % choice.options.length; choice.dispatchEvent(new Event('change')); })()",
    );
    await page.frame();
    expect((await picture(page)) !== before, 'another column is the same picture');
    // The modes are animated until they are paused; where motion is unwanted they stand still.
    const shape = "document.querySelector('.modes canvas').toDataURL()";
    const moving = await page.value(shape);
    await page.until(`${shape} !== ${JSON.stringify(moving)}`);
    await page.value("document.querySelector('.modes button').click()");
    await page.frame();
    const still = await page.value(shape);
    await page.frame();
    expect((await page.value(shape)) === still, 'the modes do not pause');
    await page.value(
      "(() => { const choice = document.querySelector('.modes select'); choice.selectedIndex = 4; choice.dispatchEvent(new Event('change')); })()",
    );
    expect((await page.value(shape)) !== still, 'another mode is the same picture');
    clean(page, 'gear.html');
    const quiet = await open('gear.html', { calm: true });
    expect((await quiet.value("document.querySelector('.modes button').textContent")) === 'Play', 'reduced motion');
    clean(quiet, 'reduced motion');
  }
  {
    // The response over the changing speed, and its range in place of one speed.
    const page = await open('ramp.html');
    const words = await page.value('document.body.innerText');
    expect(words.includes('Mesh frequency ratio Ω from 0.8 to 0.9'), 'the lead of a ramp');
    expect(words.includes('Direction: up and down'), 'the directions of a ramp');
    expect((await page.value("document.querySelectorAll('.panel').length")) === 1, 'the figure of a ramp');
    clean(page, 'ramp.html');
  }
  {
    const page = await open('unfinished.html');
    expect(
      (await page.value('document.body.innerText')).includes('This study is not complete'),
      'an unfinished study does not say so',
    );
    clean(page, 'unfinished.html');
  }

  // Without branches the type is that of the multiplier beyond the unit circle. The panel of the point ends above the
  // lower edge of the window and shows that it goes on.
  {
    const page = await open('sweep.html', { width: 1280, height: 800 });
    const types = await page.value(
      "[...document.querySelectorAll('.list tbody tr')].map(({ children }) => `${children[0].textContent}: ${children[4].textContent}`)",
    );
    expect(types.includes('2.175 to 2.2: period doubling (flip)'), `types: ${types}`);
    await page.value("document.querySelector('.list button.link').click()");
    const fits = () =>
      page.value(
        "(() => { const place = document.querySelector('.details'); return place.getBoundingClientRect().bottom <= innerHeight && place.scrollHeight > place.clientHeight; })()",
      );
    await page.frame();
    expect(await fits(), 'the panel is below the lower edge');
    await page.value('scrollTo(0, 0)');
    await page.frame();
    expect(await fits(), 'the panel is below the lower edge at the top of the page');
    const below = "document.querySelector('.below').hidden";
    expect(!(await page.value(below)), 'nothing says that the panel goes on');
    await page.value(
      "[...document.querySelectorAll('.parts button')].find((one) => one.textContent === 'Spectrum').click()",
    );
    await page.frame();
    const offset = await page.value(
      "document.querySelector('[data-part=Spectrum]').getBoundingClientRect().top - document.querySelector('.details').getBoundingClientRect().top",
    );
    expect(offset > 0 && offset < 100, `the spectrum is ${offset} px below the top of the panel`);
    await page.value(
      "(() => { const place = document.querySelector('.details'); place.scrollTop = place.scrollHeight; })()",
    );
    await page.until(below);
    // The label of a quantity that is no symbol.
    await page.value(
      "(() => { const choice = document.querySelector('#quantity'); choice.value = 'curve:period'; choice.dispatchEvent(new Event('change')); })()",
    );
    const option = await page.value("document.querySelector('#quantity').selectedOptions[0].textContent");
    expect(option.startsWith('period (Period n)'), `period is called ${option}`);
    clean(page, 'sweep.html at 1280 px');
  }
  {
    // A torus whose interval excludes 0 has a sentence on it, other points have none.
    const page = await open('torus.html');
    await page.value("document.querySelector('.figure').focus()");
    for (let k = 0; k < 3; ++k) await page.key('ArrowLeft');
    let notes = 0;
    for (let k = 0; k < 3; ++k) {
      if (k > 0) await page.key('ArrowRight');
      const text = await details(page);
      const [, value, error] = /λ1−?([0-9.]+) ± ([0-9.]+) per/.exec(text) ?? [];
      const expected = text.includes('Regimequasiperiodic') && Number(value) > Number(error);
      expect(text.includes('On a torus λ1 is 0') === expected, `the sentence on tori: ${text.slice(0, 300)}`);
      notes += expected ? 1 : 0;
    }
    expect(notes > 0, 'no interval of a torus excludes 0: choose other values');
    clean(page, 'torus.html');
  }
  {
    // Ticks of logarithmic axes: those of uPlot do not end for this range.
    const source = readFileSync(new URL('../../app/browser/panel.js', import.meta.url), 'utf8');
    const text = /function logarithmicSplits[^]*?\n}\n/.exec(source)[0];
    const splits = new Function(`${text} return logarithmicSplits;`)();
    const ticks = splits(9.670609801382717e-7, 8.13);
    expect(ticks.length === 9 * 6 + 8 && ticks[0] === 1e-6 && ticks.at(-1) === 8, `ticks ${ticks.length}: ${ticks[0]}`);
    expect(splits(0.2, 0.3).length >= 3, 'ticks of a narrow range');
  }

  // Names stay text.
  {
    const page = await open('hostile.html');
    expect(
      (await page.value("document.querySelectorAll('img, iframe, object, b').length")) === 0,
      'a name became markup',
    );
    expect(
      (await page.value('document.body.innerText')).includes('<img src=x onerror='),
      'a name is not shown as it is',
    );
    expect((await page.value('window.hurt')) === undefined, 'a name was obeyed');
    clean(page, 'hostile.html');
    // The policy: what is not of the page does not run.
    await page.value(
      "(() => { const script = document.createElement('script'); script.textContent = 'window.hurt = true'; document.body.append(script); })()",
    );
    expect((await page.value('window.hurt')) === undefined, 'the policy lets a foreign script run');
    await checks.sendsNothing(page, 'https://example.org/');
  }
});
