// node report.mjs CHROMIUM FOLDER
//
// Opens the reports in FOLDER (sweep.html, both.html, map.html, basins.html, run.html, gear.html, unfinished.html, hostile.html) as a
// reader would: no error, no request, zoom, hover, click, keys, dark, a narrow screen, a PDF.
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
    await page.send('Input.dispatchMouseEvent', {
      type: 'mouseWheel',
      x: left + 0.5 * width,
      y: top + 0.5 * height,
      deltaX: 0,
      deltaY: -300,
    });
    await page.frame();
    await page.until('true');
    expect((await picture(page)) !== chosen, 'the wheel does not zoom');
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
    const names = await page.value("[...document.querySelectorAll('#quantity option')].map((option) => option.value)");
    expect(names.includes('section:delta_rp_1') && names.includes('curve:kv_sp'), 'quantities to choose from');
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
  for (const name of ['sweep.html', 'both.html', 'map.html', 'basins.html', 'run.html', 'gear.html']) {
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
    const page = await open('unfinished.html');
    expect(
      (await page.value('document.body.innerText')).includes('This study is not complete'),
      'an unfinished study does not say so',
    );
    clean(page, 'unfinished.html');
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
