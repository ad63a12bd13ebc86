// node live.mjs CHROMIUM ADDRESS GROWING_ADDRESS MAP_ADDRESS SERVER
//
// The page of `serve` as a reader uses it: a study grows, a history is computed, a region is computed finer and cancelled,
// a slider moved, two windows; a narrow screen, dark, no error and no request to another place.
import { Browser, Checks } from './browser.mjs';

const [, , program, address, growing, map, server] = process.argv;
const checks = new Checks();
const { expect, clean } = checks;
const browser = new Browser(program);
const state = (page) => page.value("document.querySelector('.live .state').textContent");
const steps = (page) =>
  page.value("[...document.querySelectorAll('.steps button')].map((button) => button.textContent)");
const counted = (page) =>
  page.value(
    "[...document.querySelectorAll('.legend li')].reduce((sum, { textContent }) => sum + Number(/: (\\d+) point/.exec(textContent)?.[1] ?? 0), 0)",
  );
const idle = "document.body.dataset.computing === 'no'";

/// Over a part of the diagram, with Ctrl.
async function region(page, from, to) {
  const [left, top, width, height] = await page.value(
    "(() => { const box = document.querySelector('.u-over').getBoundingClientRect(); return [box.left, box.top, box.width, box.height]; })()",
  );
  const y = top + 0.5 * height;
  const at = (part) => left + part * width;
  const control = { modifiers: 2, button: 'left' };
  await page.mouse('mouseMoved', at(from), y, { modifiers: 2 });
  await page.mouse('mousePressed', at(from), y, { ...control, clickCount: 1 });
  for (let k = 1; k <= 4; ++k)
    await page.mouse('mouseMoved', at(from + (k / 4) * (to - from)), y, { ...control, buttons: 1 });
  await page.mouse('mouseReleased', at(to), y, { ...control, clickCount: 1 });
}

await checks.run(browser, async () => {
  {
    // It grows while it is read, and what was chosen stays.
    const page = await browser.open(growing);
    const before = await counted(page);
    await page.value("document.querySelector('.figure').focus()");
    await page.key('ArrowRight');
    const chosen = await page.value("document.querySelector('.details h3').textContent");
    await page.key('+', '+');
    await page.until(
      `[...document.querySelectorAll('.legend li')].reduce((sum, { textContent }) => sum + Number(/: (\\d+) point/.exec(textContent)?.[1] ?? 0), 0) > ${before}`,
    );
    expect(
      /^The study grows: \d+ of 1200 points are finished/.test(await state(page)),
      `it grows: ${await state(page)}`,
    );
    expect(
      (await page.value("document.querySelector('.details h3').textContent")) === chosen,
      'the chosen point is gone',
    );
    expect(await page.value("document.querySelector('.figure').contains(document.activeElement)"), 'the keys are gone');
    clean(page, 'growing');
  }
  {
    // What is only for sweeps is not missing without a word.
    const page = await browser.open(map);
    const text = await page.value("document.querySelector('.live').textContent");
    expect(/sliders.* only for a sweep/.test(text), `a map: ${text}`);
    expect((await page.value("document.querySelectorAll('.slider, .refine').length")) === 0, 'sliders of a map');
    clean(page, 'map');
  }
  const page = await browser.open(address);
  const all = await counted(page);
  expect(all === 18, `${all} points of the study`);

  // A longer history of a point.
  await page.value("document.querySelector('.figure').focus()");
  await page.key('ArrowRight');
  await page.value(
    "(() => { const choice = document.querySelector('[aria-label=\"Mesh periods of the history\"]'); choice.value = '16'; choice.nextSibling.click(); })()",
  );
  await page.until("document.querySelector('.history').textContent.includes('Time history of 16 mesh periods')");

  // A region, finer.
  await page.value("document.querySelector('.live input').value = '6'");
  await region(page, 0.3, 0.6);
  await page.until("document.querySelectorAll('.steps button').length === 2");
  await page.until(idle);
  await page.until(
    `[...document.querySelectorAll('.legend li')].reduce((sum, { textContent }) => sum + Number(/: (\\d+) point/.exec(textContent)?.[1] ?? 0), 0) === ${all + 12}`,
  );
  expect(
    /^Region 001: Ω 2\.159\d* to 2\.22\d*, 6 values/.test((await steps(page))[1]),
    `the history: ${await steps(page)}`,
  );
  expect(
    (await page.value("document.querySelector('.live').textContent")).includes(
      'epicyclic sweep sweep/refined/001/input.resolved.json -o sweep/refined/001',
    ),
    'the command of the region',
  );
  await page.value("document.querySelector('.steps button').click()");
  await page.until("document.querySelector('.steps button').getAttribute('aria-pressed') === 'true'");
  await page.until(`document.querySelectorAll('.toggles label').length === 2`);
  expect((await counted(page)) === all, 'back to the study');

  // Another window has the history, too; what it starts is shown in both, and each can cancel it.
  const second = await browser.open(address, { width: 390, height: 844, dark: true });
  expect((await steps(second)).length === 2, 'the history in another window');
  await second.value("document.querySelector('.live input').value = '3000'");
  await second.value("document.querySelector('.refine').click()");
  await page.until(
    "/^Computing sweep\\/refined\\/002: \\d+ of 6000 points/.test(document.querySelector('.live .state').textContent)",
  );
  expect(!(await page.value("document.querySelector('.live .line button').hidden")), 'no button to cancel');
  await page.value("document.querySelector('.live .line button').click()");
  await second.until(idle);
  await page.until(idle);
  const beyond = await second.value('document.documentElement.scrollWidth - document.documentElement.clientWidth');
  expect(beyond <= 0, `${beyond} px too wide for 390 px`);
  clean(second, 'at 390 px');

  // A slider: a coarse diagram, then the full one.
  const begun = Date.now();
  await page.value("document.querySelector('.changes').open = true");
  await page.value(
    "(() => { const slider = document.querySelector('.slider input'); slider.value = '0.09'; slider.dispatchEvent(new Event('input')); })()",
  );
  await page.until("document.querySelectorAll('.toggles label').length === 3");
  console.log(`slider to coarse diagram: ${Date.now() - begun} ms`);
  await page.until("document.querySelectorAll('.steps button').length === 5");
  await page.until(idle);
  await page.until("document.querySelectorAll('.toggles input:checked').length === 2");
  expect((await steps(page))[4].startsWith('Change 002: damping ratio = 0.09;'), `the steps: ${await steps(page)}`);
  expect((await counted(page)) === 18 + 41 + 18, `${await counted(page)} points of study, coarse and full diagram`);

  // A number that is not valid is refused in words.
  await page.value(
    "(() => { const exact = document.querySelector('.slider input[type=number]'); exact.value = '-1'; exact.dispatchEvent(new Event('change')); })()",
  );
  await page.until("document.querySelector('.live .warning') && !document.querySelector('.live .warning').hidden");
  expect(
    /damping_ratio/.test(await page.value("document.querySelector('.live .warning').textContent")),
    'why a number is refused',
  );
  page.wrong = page.wrong.filter((text) => !/status of 422/.test(text));
  clean(page, 'live');

  // The server ends: the page says so, and keeps what it shows.
  process.kill(Number(server), 'SIGTERM');
  await page.until("!document.querySelector('main > .warning').hidden");
  expect((await counted(page)) > 0, 'nothing is shown any more');

  // The policy: nothing but the server is reached.
  await checks.sendsNothing(page, 'http://127.0.0.1:9/');
});
