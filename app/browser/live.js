// The page of `serve`: asks the server for studies while they grow, has regions computed finer and numbers changed, and
// keeps a history of both. Nothing here is in use on the page of a report.
import { readPayload } from './payload.js';
import { element, number, unitText } from './words.js';
import { releasePanels } from './panel.js';
import { commandLine } from './details.js';

const slow = 1000; // ms between two questions for the state
const fast = 300; // ms, while something is computed
const most = 4; // numbers that are changed at a time

/// Asks the server.
/// @throws Error with the server's words and its status, 0 without an answer
async function request(action, body = {}) {
  const answer = await fetch(action, {
    method: 'POST',
    headers: { 'Content-Type': 'application/json' },
    body: JSON.stringify(body),
    cache: 'no-store',
  }).catch(() => {
    throw Object.assign(new Error('the server does not answer'), { status: 0 });
  });
  if (!answer.ok) {
    const { error } = await answer.json().catch(() => ({}));
    throw Object.assign(new Error(error ?? `the server answers ${answer.status}`), { status: answer.status });
  }
  return answer;
}

/// The studies on the page, as the server has them.
class Source {
  constructor() {
    this.loaded = new Map(); // by the number of the study: { revision, study, program }
    this.next = new Map(); // when one may be fetched again
  }

  /// The study as it is now, or as it was a moment ago; null if nothing of it can be shown yet.
  async study({ id, revision }) {
    const known = this.loaded.get(id);
    if (known && (known.revision === revision || performance.now() < this.next.get(id))) return known;
    const begun = performance.now();
    const answer = await request('data', { study: id });
    if (answer.status === 202) return known ?? { message: (await answer.json()).error };
    const header = await readPayload(await answer.text());
    // A large study is not fetched all the time.
    this.next.set(id, performance.now() + Math.max(1000, 5 * (performance.now() - begun)));
    const made = { revision, study: header.studies[0], header };
    this.loaded.set(id, made);
    return made;
  }
}

/// Words of a step of the history.
function stepText({ folder, how }, symbol) {
  const name = folder.split('/').pop();
  const region = `${symbol} ${number(how.from, 6)} to ${number(how.to, 6)}, ${how.values} values`;
  const changes = how.changes.map((change) => `${shortName(change.name)} = ${number(change.value, 4)}`).join(', ');
  return `${how.place === 'refined' ? 'Region' : 'Change'} ${name}: ${[changes, region].filter(Boolean).join('; ')}`;
}

const shortName = (name) =>
  name
    .split('/')
    .filter((step) => !/^(stage|lumped|load|)$/.test(step))
    .join(' ')
    .replace(/_(um|mm|kW|Nm|N_per_m|deg|kg|GPa|mPas)\b/, '')
    .replace(/_/g, ' ');
const sameChanges = (a, b) => JSON.stringify(a.how.changes) === JSON.stringify(b.how.changes);

/// One root study, or several in one diagram, with what was derived from it.
class Part {
  constructor(live, roots) {
    this.live = live;
    this.roots = roots; // numbers
    this.sweep = roots.find((id) => live.state.studies[id].sweep) ?? roots[0];
    this.selected = null; // of the history
    this.figures = null;
    this.drawn = '';
    this.node = element('div');
    this.content = element('div');
    this.status = element('span', { class: 'state' });
    this.said = element('span', { role: 'status', class: 'unseen' }); // for screen readers, not with each point
    this.cancel = element('button', { type: 'button', text: 'Cancel', hidden: true, onclick: () => live.cancel() });
    this.message = element('p', { class: 'warning', role: 'alert', hidden: true });
    this.steps = element('ol', { class: 'steps', 'aria-label': 'History' });
    this.command = element('details', {}, element('summary', { text: 'Command of this step' }));
    this.node.append(
      element(
        'section',
        { class: 'live', 'aria-label': 'Live' },
        element('p', { class: 'line' }, this.status, this.said, ' ', this.cancel),
        this.message,
        (this.tools = element('div')),
        this.steps,
        this.command,
      ),
      this.content,
    );
  }

  history(study, point, periods) {
    return request('history', { study: study.served, point, periods }).then((answer) => answer.json());
  }

  get root() {
    return this.sweep;
  }

  say(text) {
    this.message.textContent = text;
    this.message.hidden = !text;
  }

  derived(state) {
    return state.studies.filter(({ root }) => root === this.root);
  }

  /// Numbers of the studies that are drawn, and those of them that are at first hidden.
  chosen(state) {
    const all = this.derived(state);
    const own = all.find(({ id }) => id === this.selected);
    if (!own) return { ids: this.roots, hidden: new Set() };
    const before = all.filter((one) => one.id <= own.id && sameChanges(one, own) && one.how.place === 'refined');
    const full = all.filter((one) => sameChanges(one, own) && one.how.place === 'changed' && one.id <= own.id);
    const same = own.how.changes.length === 0;
    // Of a coarse diagram and a full one, the coarse one is there until the other is.
    const shown = own.how.place === 'changed' ? full.slice(-2) : [...full.slice(-1), ...before];
    const coarse = shown.filter((one) => one.how.place === 'changed').slice(0, -1);
    const done = this.live.state.computing?.study !== own.id;
    return {
      ids: [...new Set([...this.roots, ...shown.map(({ id }) => id)])],
      hidden: new Set([...(same ? [] : this.roots), ...(done ? coarse.map(({ id }) => id) : [])]),
    };
  }

  async update(state) {
    const { ids, hidden } = this.chosen(state);
    const loaded = [];
    for (const id of ids) {
      const one = await this.live.source.study(state.studies[id]);
      if (one.study) loaded.push([id, one]);
      else if (id === this.root) this.content.textContent = `${one.message}.`;
    }
    const drawn = JSON.stringify([loaded.map(([id, { revision }]) => [id, revision]), [...hidden]]);
    this.show(state);
    if (loaded.length === 0 || drawn === this.drawn || this.live.held) return;
    this.drawn = drawn;
    this.draw(loaded, hidden, state);
  }

  draw(loaded, hidden, state) {
    const group = loaded.map(([id, { study }]) => {
      const { how } = state.studies[id];
      return Object.assign(study, {
        shown: !hidden.has(id),
        live: this,
        derived: Boolean(how),
        label: how ? `${how.place} ${state.studies[id].folder.split('/').pop()}` : study.label,
      });
    });
    const memory = this.figures?.remember?.();
    const open = [...this.content.querySelectorAll('.study > details')].map((part) => part.open);
    const focused = this.content.querySelector('.figure')?.contains(document.activeElement);
    const [part, host] = this.live.build.part(group, {
      ...loaded[0][1].header,
      studies: this.live.parts.flatMap(({ roots }) => roots),
    });
    this.content.replaceChildren(part);
    this.figures = this.live.build.figures(group, host, memory);
    this.content.querySelectorAll('.study > details').forEach((one, k) => (one.open = open[k] ?? one.open));
    if (focused) this.content.querySelector('.figure')?.focus({ preventScroll: true });
    releasePanels();
    const changeable = group.find(({ numbers }) => numbers?.length > 0);
    if (!this.toolsMade && changeable) this.makeTools(changeable);
    else if (!this.toolsMade && !group.some(({ kind }) => kind === 'sweep'))
      this.tools.replaceChildren(
        element('p', {
          class: 'hint',
          text: 'Finer regions and sliders for numbers of the input are only for a sweep, and this study is none.',
        }),
      );
    document.body.dataset.drawn = String(Number(document.body.dataset.drawn ?? 0) + 1);
  }

  // ---- what is going on -----------------------------------------------------------------------------------------

  show(state) {
    const { computing } = state;
    const mine = computing && state.studies[computing.study]?.root === this.root;
    const root = this.live.source.loaded.get(this.root)?.study;
    const progress =
      root?.run.state === 'complete'
        ? 'The study is complete.'
        : `The study grows: ${root?.progress ?? 'no point is finished'}.`;
    this.status.textContent = mine
      ? `Computing ${state.studies[computing.study].folder}: ${computing.done} of ${computing.total || '?'} points, ${computing.seconds.toFixed(0)} s.`
      : computing
        ? `${progress} Another part of this page is being computed.`
        : progress;
    this.cancel.hidden = !mine;
    const situation = mine ? `computing ${computing.study}` : (root?.run.state ?? '');
    if (situation !== this.situation) this.said.textContent = this.status.textContent;
    this.situation = situation;
    const steps = this.derived(state);
    const key = JSON.stringify([steps.map(({ id }) => id), this.selected]);
    if (key === this.stepsShown || !root) return;
    this.stepsShown = key;
    const step = (text, id) =>
      element(
        'li',
        {},
        element('button', {
          type: 'button',
          text,
          'aria-pressed': String(this.selected === id),
          onclick: () => this.select(id),
        }),
      );
    this.steps.replaceChildren(
      ...(steps.length > 0 ? [step('The study', null)] : []),
      ...steps.map((one) => step(stepText(one, root.parameter.symbol), one.id)),
    );
    const own = steps.find(({ id }) => id === this.selected);
    this.command.hidden = !own;
    if (!own) return;
    const hint = element('p', { class: 'hint', text: 'It resumes what was cancelled, without this page:' });
    this.command.replaceChildren(this.command.firstChild, hint, commandLine(own.command));
  }

  select(id) {
    this.selected = id;
    this.say('');
    this.live.poll();
  }

  // ---- finer regions --------------------------------------------------------------------------------------------

  /// @param range  of the parameter
  async refine([from, to]) {
    this.say('');
    try {
      const { study } = await (
        await request('refine', {
          study: this.selected ?? this.root,
          from,
          to,
          values: this.values.valueAsNumber,
          records: Number(this.records.value),
        })
      ).json();
      this.select(study);
    } catch (error) {
      this.say(error.message);
    }
  }

  makeTools(study) {
    this.toolsMade = true;
    this.values = element('input', { type: 'number', value: '121', min: '2', max: '20000', step: '1' });
    this.records = element(
      'select',
      {},
      [1, 2, 4, 8].map((factor) =>
        element('option', { value: String(factor), text: `${factor * study.recorded_periods} mesh periods` }),
      ),
    );
    const field = (text, control) => element('label', {}, element('span', { text }), control);
    const sliders = element('div', { class: 'sliders' });
    this.sliders = [];
    const suggested = study.numbers.map((one, k) => [one, k]).filter(([one]) => one.suggested);
    for (const [, k] of suggested.slice(0, most)) this.addSlider(sliders, study, k);
    const more = element('select', {
      'aria-label': 'Number to change',
      onchange: () => {
        if (more.selectedIndex > 0 && this.sliders.length < most)
          this.addSlider(sliders, study, more.selectedIndex - 1);
        more.selectedIndex = 0;
      },
    });
    more.append(
      element('option', { text: 'Another number' }),
      ...study.numbers.map((one) => element('option', { text: shortName(one.name) })),
    );
    this.after = element('input', { type: 'checkbox', checked: true });
    this.tools.append(
      element(
        'div',
        { class: 'toolbar' },
        field('Values in the region', this.values),
        field('Record of each', this.records),
        element('button', {
          type: 'button',
          class: 'refine',
          text: 'Compute the shown range finer',
          onclick: () => this.refine(this.figures.shownRange()),
        }),
        element('span', { class: 'hint', text: 'Or drag over a region of the diagram with Ctrl.' }),
      ),
      element(
        'details',
        { class: 'changes' },
        element('summary', { text: 'Change numbers of the input' }),
        sliders,
        element(
          'div',
          { class: 'toolbar' },
          more,
          element('label', { class: 'toggle' }, this.after, 'Compute the full diagram, too'),
          element('button', { type: 'button', text: 'Back to the values of the study', onclick: () => this.reset() }),
        ),
      ),
    );
  }

  // ---- changed numbers ------------------------------------------------------------------------------------------

  addSlider(host, study, k) {
    if (this.sliders.some((slider) => slider.number === k)) return;
    const { name, meaning, unit, value, is_factor: factor } = study.numbers[k];
    const [low, high] = factor ? [0, 3] : value === 0 ? [0, 1] : [Math.min(0, 2 * value), Math.max(0, 2 * value)];
    const step = String((high - low) / 200);
    const range = element('input', {
      type: 'range',
      min: String(low),
      max: String(high),
      step,
      value: String(value),
      'aria-label': shortName(name),
    });
    const exact = element('input', {
      type: 'number',
      step: 'any',
      value: String(value),
      'aria-label': `${shortName(name)}, value`,
    });
    const slider = { number: k, base: value, value, range, exact };
    const take = (text, other) => {
      const next = Number(text);
      if (text === '' || !Number.isFinite(next)) return;
      slider.value = next;
      other.value = String(next);
      clearTimeout(this.timer);
      this.timer = setTimeout(() => this.change(true), 250);
    };
    range.addEventListener('input', () => take(range.value, exact));
    exact.addEventListener('change', () => take(exact.value, range));
    range.value = String(value);
    this.sliders.push(slider);
    host.append(
      element(
        'div',
        { class: 'slider' },
        element('span', {
          class: 'name',
          title: `${name}: ${meaning}`,
          text: `${shortName(name)}${factor ? ' (factor)' : ''}${unitText(unit) ? ` [${unitText(unit)}]` : ''}`,
        }),
        range,
        exact,
        element('button', {
          type: 'button',
          text: '×',
          title: 'Remove',
          'aria-label': `Remove ${shortName(name)}`,
          onclick: (event) => {
            this.sliders.splice(this.sliders.indexOf(slider), 1);
            event.currentTarget.parentNode.remove();
          },
        }),
      ),
    );
  }

  reset() {
    for (const slider of this.sliders) {
      slider.value = slider.base;
      slider.range.value = slider.exact.value = String(slider.base);
    }
    clearTimeout(this.timer);
    this.waiting = null;
    this.select(null);
  }

  async change(coarse) {
    const numbers = this.sliders
      .filter(({ value, base }) => value !== base)
      .map(({ number: k, value }) => ({ number: k, value }));
    if (numbers.length === 0) return this.select(null);
    this.say('');
    try {
      const { study } = await (await request('change', { study: this.root, numbers, coarse })).json();
      this.waiting = coarse ? study : null;
      this.select(study);
    } catch (error) {
      this.say(error.message);
    }
  }

  /// The full diagram follows the coarse one.
  ended({ study, code, message }, state) {
    if (state.studies[study]?.root !== this.root) return;
    if (message) this.say(message);
    else if (![0, 1, 75].includes(code))
      this.say(`It ended with exit code ${code}. The terminal of the server says why.`);
    if (this.waiting === study && (code === 0 || code === 1) && this.after.checked) this.change(false);
    if (this.waiting === study) this.waiting = null;
  }
}

export class Live {
  /// @param build  part(group, header) and figures(group, host, memory) of the page
  constructor(page, build) {
    this.page = page;
    this.build = build;
    this.source = new Source();
    this.parts = [];
    this.held = false; // while a button of the mouse is down
    addEventListener('pointerdown', ({ target }) => (this.held = Boolean(target.closest?.('.u-over'))), true);
    for (const end of ['pointerup', 'pointercancel']) addEventListener(end, () => (this.held = false), true);
    this.lost = element('p', {
      class: 'warning',
      role: 'alert',
      hidden: true,
      text: 'The server does not answer. What is shown stays; nothing is lost. Start `epicyclic serve` again.',
    });
    page.replaceChildren(this.lost);
  }

  async start() {
    this.state = await (await request('state')).json();
    const roots = this.state.studies.filter(({ root }) => root === undefined);
    const loaded = [];
    for (const root of roots) loaded.push({ id: root.id, ...(await this.source.study(root)) });
    const known = this.build.groups(
      loaded.filter(({ study }) => study).map(({ id, study }) => Object.assign(study, { served: id })),
    );
    for (const group of known)
      this.parts.push(
        new Part(
          this,
          group.map(({ served }) => served),
        ),
      );
    for (const { id, study } of loaded) if (!study) this.parts.push(new Part(this, [id]));
    this.parts.sort((a, b) => a.root - b.root);
    this.page.append(...this.parts.map(({ node }) => node));
    this.lastEnded = JSON.stringify(this.state.last);
    await this.poll();
  }

  async cancel() {
    await request('cancel').catch(() => {});
    this.poll();
  }

  /// One question at a time; the next one follows by itself.
  async poll() {
    clearTimeout(this.timer);
    if (this.asking) return (this.again = true);
    this.asking = true;
    let wait = slow;
    try {
      this.state = await (await request('state')).json();
      this.lost.hidden = true;
      document.body.dataset.computing = this.state.computing ? 'yes' : 'no';
      for (const part of this.parts) await part.update(this.state);
      const { last } = this.state;
      if (last && JSON.stringify(last) !== this.lastEnded && !this.state.computing) {
        this.lastEnded = JSON.stringify(last);
        for (const part of this.parts) part.ended(last, this.state);
      }
      if (this.state.computing) wait = fast;
    } catch (error) {
      if (error.status === 0) this.lost.hidden = false;
      else if (error.status === undefined) throw error;
      wait = 3 * slow;
    } finally {
      this.asking = false;
      this.timer = setTimeout(() => this.poll(), this.again ? 0 : wait);
      this.again = false;
    }
  }
}
