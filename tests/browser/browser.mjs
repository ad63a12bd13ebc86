// A headless Chromium over its debugging pipe, without packages: messages are JSON, each ended by a zero byte.
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const patience = 60_000; // ms, of one message

export class Browser {
  constructor(program) {
    this.profile = mkdtempSync(join(tmpdir(), 'report-browser-'));
    this.process = spawn(
      program,
      [
        '--headless',
        '--no-sandbox',
        '--disable-gpu',
        '--disable-dev-shm-usage',
        '--no-first-run',
        '--disable-background-networking',
        '--remote-debugging-pipe',
        `--user-data-dir=${this.profile}`,
      ],
      { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] },
    );
    this.last = 0;
    this.waiting = new Map();
    this.listeners = [];
    let text = '';
    this.process.stdio[4].on('data', (bytes) => {
      text += bytes.toString('utf8');
      for (let end = text.indexOf('\0'); end >= 0; end = text.indexOf('\0')) {
        this.receive(JSON.parse(text.slice(0, end)));
        text = text.slice(end + 1);
      }
    });
  }

  receive(message) {
    const waiting = this.waiting.get(message.id);
    if (waiting) {
      this.waiting.delete(message.id);
      clearTimeout(waiting.timer);
      if (message.error) waiting.reject(new Error(message.error.message));
      else waiting.resolve(message.result);
    } else {
      for (const listener of this.listeners) listener(message);
    }
  }

  send(method, params = {}, sessionId) {
    const id = ++this.last;
    this.process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => reject(new Error(`no answer to ${method}`)), patience);
      this.waiting.set(id, { resolve, reject, timer });
    });
  }

  /// A page with what goes wrong on it: errors of the console, exceptions, and requests for anything but itself.
  async open(url, { width = 1440, height = 1000, dark = false, calm = false } = {}) {
    const { targetId } = await this.send('Target.createTarget', { url: 'about:blank' });
    const { sessionId } = await this.send('Target.attachToTarget', { targetId, flatten: true });
    const page = new Page(this, sessionId, url);
    for (const domain of ['Page', 'Runtime', 'Log', 'Network']) await page.send(`${domain}.enable`);
    await page.send('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: 1, mobile: width < 500 });
    await page.send('Emulation.setEmulatedMedia', {
      features: [
        { name: 'prefers-color-scheme', value: dark ? 'dark' : 'light' },
        { name: 'prefers-reduced-motion', value: calm ? 'reduce' : 'no-preference' },
      ],
    });
    await page.send('Page.navigate', { url });
    await page.until('document.body && document.body.dataset.state !== undefined');
    await page.frame();
    return page;
  }

  async close() {
    const ended = new Promise((resolve) => this.process.once('exit', resolve));
    await this.send('Browser.close').catch(() => this.process.kill());
    await Promise.race([ended, new Promise((resolve) => setTimeout(resolve, 10_000))]);
    this.process.kill('SIGKILL');
    rmSync(this.profile, { recursive: true, force: true, maxRetries: 5 });
  }
}

export class Page {
  constructor(browser, session, url) {
    this.browser = browser;
    this.session = session;
    this.wrong = [];
    browser.listeners.push(({ method, params, sessionId }) => {
      if (sessionId !== session) return;
      if (method === 'Runtime.exceptionThrown')
        this.wrong.push(`exception: ${params.exceptionDetails.exception?.description ?? params.exceptionDetails.text}`);
      if (method === 'Runtime.consoleAPICalled' && ['error', 'warning', 'assert'].includes(params.type))
        this.wrong.push(`console: ${JSON.stringify(params.args)}`);
      if (method === 'Log.entryAdded' && ['error', 'warning'].includes(params.entry.level))
        this.wrong.push(`log: ${params.entry.text}`);
      if (method === 'Network.requestWillBeSent' && !params.request.url.startsWith(url))
        this.wrong.push(`request: ${params.request.url.slice(0, 100)}`);
    });
  }

  send(method, params = {}) {
    return this.browser.send(method, params, this.session);
  }

  /// The value of an expression, promises awaited.
  async value(expression) {
    const { result, exceptionDetails } = await this.send('Runtime.evaluate', {
      expression,
      awaitPromise: true,
      returnByValue: true,
    });
    if (exceptionDetails)
      throw new Error(`${expression}: ${exceptionDetails.exception?.description ?? exceptionDetails.text}`);
    return result.value;
  }

  async until(expression) {
    const end = Date.now() + patience;
    while (!(await this.value(expression).catch(() => false))) {
      if (Date.now() > end) throw new Error(`never true: ${expression}`);
      await new Promise((resolve) => setTimeout(resolve, 20));
    }
  }

  /// Waits until the page has been drawn.
  frame() {
    return this.value(
      'new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => resolve(true))))',
    );
  }

  async mouse(type, x, y, more = {}) {
    await this.send('Input.dispatchMouseEvent', { type, x, y, button: 'none', ...more });
  }

  async wheel(x, y, deltaY, modifiers = 0) {
    await this.mouse('mouseWheel', x, y, { deltaX: 0, deltaY, modifiers });
  }

  async click(x, y, count = 1) {
    await this.mouse('mouseMoved', x, y);
    for (let n = 1; n <= count; ++n) {
      await this.mouse('mousePressed', x, y, { button: 'left', clickCount: n });
      await this.mouse('mouseReleased', x, y, { button: 'left', clickCount: n });
    }
    await this.frame();
  }

  async drag(from, to) {
    await this.mouse('mouseMoved', ...from);
    await this.mouse('mousePressed', ...from, { button: 'left', clickCount: 1 });
    for (let k = 1; k <= 4; ++k)
      await this.mouse('mouseMoved', from[0] + (k / 4) * (to[0] - from[0]), from[1] + (k / 4) * (to[1] - from[1]), {
        button: 'left',
        buttons: 1,
      });
    await this.mouse('mouseReleased', ...to, { button: 'left', clickCount: 1 });
    await this.frame();
  }

  async key(key, text) {
    await this.send('Input.dispatchKeyEvent', { type: 'keyDown', key, text });
    await this.send('Input.dispatchKeyEvent', { type: 'keyUp', key });
    await this.frame();
  }
}

/// Checks of pages, counted; `run` ends the process.
export class Checks {
  failed = 0;

  expect = (holds, what) => {
    if (holds) return;
    console.log(`FAILED: ${what}`);
    ++this.failed;
  };

  clean = (page, name) => this.expect(page.wrong.length === 0, `${name}: ${page.wrong.join('\n')}`);

  /// The policy of the page lets no request go to this address.
  async sendsNothing(page, address) {
    const refused = await page.value(`new Promise((resolve) => {
      document.addEventListener('securitypolicyviolation', (event) => resolve(event.effectiveDirective));
      fetch('${address}').then(() => resolve('sent'), () => setTimeout(() => resolve('failed'), 500));
    })`);
    this.expect(refused === 'connect-src', `the policy lets a request go: ${refused}`);
  }

  async run(browser, checks) {
    try {
      await checks();
    } catch (error) {
      this.expect(false, error.stack);
    } finally {
      await browser.close();
    }
    console.log(`${this.failed} failures`);
    process.exit(this.failed === 0 ? 0 : 1);
  }
}
