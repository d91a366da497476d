// SPDX-License-Identifier: Apache-2.0
import { Changes } from './changes';
import { call } from './connection';
import { Drag } from './drag';
import { element } from './dom';
import { Form } from './form';
import { routed } from './issues';
import type { Live } from './live';
import { mayBeginAnew } from './loss';
import { type Answer, type Json, type Scenario, said } from './protocol';
import { differing, without } from './preset';
import { parametersNote } from './repeat';
import type { Schema } from './schema';
import { at, combine, keyOf, text } from './settings';

const refused: Answer = {
  type: 'answer',
  id: 0,
  issues: [{ keys: [], text: 'This needs a new run: stop the rig first.' }],
};
const kept: Answer = { type: 'answer', id: 0, issues: [{ keys: [], text: 'The run continues.' }] };

let schemaOnce: Promise<Schema> | undefined;

/** The scenario's parameters: a form, and what becomes of the changes in it. */
export class Parameters {
  readonly root: HTMLElement;
  private schema: Schema | undefined;
  private shape = '';
  private readonly changes = new Changes();
  private setting: Promise<unknown> = Promise.resolve(); // the last one sent
  private readonly drag = new Drag((key, value) => this.live.ask({ do: 'set', key, value: text(value) }));
  private readonly done: [string, Json][] = []; // keys changed, and the values before
  private readonly tuned = new Map<string, Json>(); // objects by key and type, as they were left
  private readonly form: Form;
  private readonly search = element('input', {
    type: 'search',
    class: 'search',
    placeholder: 'Find a parameter',
    'aria-label': 'Find a parameter',
    oninput: () => this.filter(),
  });
  private readonly undoButton = element(
    'button',
    {
      type: 'button',
      class: 'undo',
      title: 'Take the last change back',
      hidden: true,
      onclick: () => void this.undo(),
    },
    '↶ Undo',
  );
  private readonly bar = element('div', { class: 'waiting', role: 'status', hidden: true });
  private readonly trouble = element('p', { class: 'issue', role: 'alert', hidden: true });

  /** `name` is the form's own in its page. */
  constructor(
    private readonly live: Live,
    name = 'field',
  ) {
    this.form = new Form(
      {
        wanted: () => this.wanted(),
        change: (key, value, drags) => void (drags ? this.drags(key, value) : this.change(key, value)),
        changeType: (key, type) => this.changeType(key, type),
        preset: (key, schema, isPublished) => void this.preset(key, schema, isPublished),
        isAtOnce: (key) => this.isAtOnce(key),
        canChange: () => !live.hello?.playback,
      },
      name,
    );
    const when = element('p', { class: 'when', role: 'status', hidden: true });
    this.root = element(
      'div',
      { class: 'parameters' },
      element('div', { class: 'find' }, this.search, this.undoButton),
      when,
      this.trouble,
      this.form.root,
      this.bar,
    );
    let ended = false;
    live.listen((message) => {
      if (message.type === 'standing' || message.type === 'frame') {
        const text = parametersNote(
          live.hello?.playback ?? false,
          live.standing,
          live.shown,
          live.history.times.at(-1) ?? 0,
        );
        when.hidden = text === '';
        if (when.textContent !== text) when.textContent = text;
      }
      if (message.type === 'hello' || message.type === 'scenario') {
        this.changes.take(message.scenario);
        this.rebuild();
      }
      if (message.type === 'standing' && message.ended !== ended) {
        ended = message.ended;
        this.rebuild();
      }
    });
    schemaOnce ??= call<Schema>('GET', '/api/schema');
    void schemaOnce.then((schema) => {
      this.schema = schema;
      this.rebuild();
    });
  }

  /** Restarts the experiment with all changes and `more` settings KEY=VALUE; `name`: of the run, if there are several. */
  async restart(more: string[] = [], name = ''): Promise<Answer> {
    await this.setting;
    const asked = [...this.changes.settings(), ...more].map(keyOf);
    const settings = combine(this.settings(), more);
    const isArmed = this.live.rig?.state === 'armed';
    if (!isArmed && !(await mayBeginAnew(this.live, name))) return kept;
    const answer = isArmed ? refused : await this.live.ask({ do: 'restart', settings });
    if (answer.issues.length === 0) this.changes.clear();
    this.showIssues(answer, asked);
    this.showWaiting();
    return answer;
  }

  /** Settings of a session that starts in this one's current state. */
  settings(): string[] {
    if (this.live.hello?.playback) return this.live.hello.settings; // its changes are in the record
    return combine(this.live.hello?.settings ?? [], this.live.standing?.changes ?? [], this.changes.settings());
  }

  /** Whether a key takes effect at the next tick, otherwise at a restart. */
  isAtOnce(key: string): boolean {
    const top = key.split('.')[0] as string;
    return !this.live.standing?.ended && (this.live.hello?.changeable.includes(top) ?? false);
  }

  async change(key: string, value: Json): Promise<Answer | undefined> {
    const before = this.drag.end(key) ?? at(this.wanted(), key);
    const answer = await this.apply(key, value);
    if (before !== undefined && !answer?.issues.length) this.done.push([key, before]);
    this.undoButton.hidden = this.done.length === 0;
    return answer;
  }

  /** Takes a value of a slider that is being dragged. What is refused meanwhile is said at the end of the drag. */
  private drags(key: string, value: Json): void {
    const { looks_back: isPast, ended } = this.live.standing ?? { looks_back: true, ended: true };
    if (this.isAtOnce(key) && !isPast && !ended) this.drag.move(key, value, at(this.wanted(), key));
  }

  /** Takes the last change back, by another one. */
  private async undo(): Promise<void> {
    const last = this.done.pop();
    if (last) await this.apply(...last);
    this.undoButton.hidden = this.done.length === 0;
  }

  private async apply(key: string, value: Json): Promise<Answer | undefined> {
    if (this.isAtOnce(key)) {
      const answered = this.changes.ask(key, value);
      const set = this.live.ask({ do: 'set', key, value: text(value) });
      this.setting = set;
      const answer = await set;
      answered();
      if (answer.issues.length === 0) this.rebuild();
      this.showIssues(answer, [key]);
      return answer;
    }
    this.changes.wait(key, value, this.live.hello?.scenario);
    this.rebuild();
    return undefined;
  }

  /** Changes the type of an object, which gets its defaults, or the values that it had with this type before. */
  private changeType(key: string, type: string): void {
    const present = at(this.wanted(), key);
    if (present && typeof present === 'object' && !Array.isArray(present))
      this.tuned.set(`${key}:${String(present['type'])}`, present);
    void this.change(key, this.tuned.get(`${key}:${type}`) ?? { type });
  }

  /** Sets an object as published or not; values that a paper's method cannot have go back to their defaults. */
  private async preset(key: string, schema: Schema, isPublished: boolean): Promise<void> {
    const present = at(this.wanted(), key);
    if (!present || typeof present !== 'object' || Array.isArray(present)) return;
    const own = { ...differing(schema, present), as_published: isPublished, type: present['type'] ?? '' };
    const answer = await this.change(key, own);
    if (!answer?.issues.length || !isPublished) return;
    await this.change(key, without(key, own, answer.issues));
  }

  private wanted(): Scenario {
    return this.changes.wanted(this.live.hello?.scenario);
  }

  /** Shows the current values; the form is rebuilt only if its fields changed. */
  private rebuild(): void {
    const { hello } = this.live;
    if (!this.schema || !hello) return;
    const scenario = this.wanted();
    const shape = JSON.stringify([shapeOf(scenario), this.live.standing?.ended]);
    if (shape !== this.shape) {
      const { lo, hi } = hello.map;
      this.form.build(this.schema, scenario, Math.hypot(hi[0] - lo[0], hi[1] - lo[1]));
      this.shape = shape;
      this.filter();
    }
    for (const one of this.form.fields) {
      one.show(at(scenario, one.key));
      one.setWaiting(this.changes.waits(one.key));
      if (hello.playback) one.setEnabled(false);
    }
    this.showWaiting();
  }

  private filter(): void {
    this.form.filter(
      this.search.value
        .toLowerCase()
        .split(/\s+/)
        .filter((one) => one !== ''),
    );
  }

  /** Shows each issue at its field, or above the form. */
  private showIssues(answer: Answer, asked: string[]): void {
    const { at: places, loose } = routed(
      answer.issues,
      this.form.fields.map((one) => one.key),
      asked,
    );
    this.trouble.hidden = loose.length === 0;
    this.trouble.textContent = said({ ...answer, issues: loose });
    this.form.showIssues(places);
  }

  private discard(): void {
    this.changes.clear();
    this.rebuild();
    this.showIssues({ ...kept, issues: [] }, []);
  }

  private showWaiting(): void {
    const { count } = this.changes;
    this.bar.hidden = count === 0;
    if (count === 0) return;
    const button = (label: string, name: string, act: () => void) =>
      element('button', { type: 'button', class: name, onclick: act }, label);
    this.bar.replaceChildren(
      element(
        'span',
        {},
        count === 1 ? 'One change takes effect after a restart.' : `${count} changes take effect after a restart.`,
      ),
      button('Restart', 'primary restart', () => void this.restart()),
      button('Discard', 'discard', () => this.discard()),
    );
  }
}

/** Shape of a scenario's form: the types of its objects and the lengths of its lists. */
function shapeOf(value: Json): Json {
  if (Array.isArray(value)) return value.some((one) => one && typeof one === 'object') ? value.map(shapeOf) : 0;
  if (value === null || typeof value !== 'object') return value === null ? null : 0;
  return Object.fromEntries(Object.entries(value).map(([key, one]) => [key, key === 'type' ? one : shapeOf(one)]));
}
