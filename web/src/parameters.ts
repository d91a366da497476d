// SPDX-License-Identifier: Apache-2.0
import { Changes } from './changes';
import { call } from './connection';
import { openBranch } from './copies';
import { Drag } from './drag';
import { element } from './dom';
import { Form } from './form';
import { routed } from './issues';
import type { Live } from './live';
import { askWhen, mayBeginAnew } from './loss';
import { Mover } from './mover';
import { type Answer, type Json, type Scenario, said } from './protocol';
import { differing, without } from './preset';
import { parametersNote } from './repeat';
import type { Schema } from './schema';
import { shapeOf } from './shape';
import { at, combine, isSame, keyOf, text } from './settings';
import { Tuned } from './tuned';
import { Undo, restartStep } from './undo';
import { waitingBar } from './waiting_bar';

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
  private readonly undone = new Undo();
  private readonly tuned = new Tuned();
  private seen: Scenario = {}; // the last one in the form
  private readonly form: Form;
  private readonly mover: Mover;
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
  private readonly bar = waitingBar(
    () => void this.restart(),
    () => this.discard(),
  );
  private readonly trouble = element('p', { class: 'issue', role: 'alert', hidden: true });

  /** `name` is the form's own in its page. */
  constructor(
    private readonly live: Live,
    name = 'field',
  ) {
    this.form = new Form(
      {
        wanted: () => this.wanted(),
        change: (key, value, drags) => void (drags ? this.drags(key, value) : this.change(key, () => value)),
        changeType: (key, type) => this.changeType(key, type),
        preset: (key, schema, isPublished) => void this.preset(key, schema, isPublished),
        isAtOnce: (key) => this.isAtOnce(key),
        canChange: () => !live.hello?.playback,
        listTools: (key) => (this.hasMovers(key) ? this.mover.addButton() : []),
        entryTools: (key, index) => (this.hasMovers(key) ? this.mover.moveButton(index) : []),
      },
      name,
    );
    this.mover = new Mover(
      {
        scenario: () => this.wanted(),
        map: () => live.hello?.map ?? { lo: [0, 0], hi: [1, 1] },
        change: (key, make) => this.change(key, make),
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
      this.bar.root,
    );
    let ended = false;
    live.listen((message) => {
      if (message.type === 'standing' || message.type === 'frame') {
        const text = parametersNote(live.hello?.playback ?? false, live.standing, live.shown);
        when.hidden = text === '';
        if (when.textContent !== text) when.textContent = text;
        if (message.type === 'standing') this.showUndo();
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
    const step = restartStep(more, this.live.hello?.scenario);
    const answer = await this.beginAnew(settings, name);
    if (answer.issues.length === 0) {
      this.changes.clear();
      this.undone.push(step);
    }
    this.showIssues(answer, asked);
    this.showWaiting();
    this.showUndo();
    return answer;
  }

  private async beginAnew(settings: string[], name: string): Promise<Answer> {
    const isArmed = this.live.rig?.state === 'armed';
    if (!isArmed && !(await mayBeginAnew(this.live, name))) return kept;
    return isArmed ? refused : this.live.ask({ do: 'restart', settings });
  }

  /** Settings of a session that starts in this one's current state. */
  settings(): string[] {
    if (this.live.hello?.playback) return this.live.hello.settings; // its changes are in the record
    return combine(this.live.hello?.settings ?? [], this.live.standing?.changes ?? [], this.changes.settings());
  }

  /** Whether a key takes effect at the next tick, otherwise at a restart. */
  isAtOnce(key: string): boolean {
    return !this.live.standing?.ended && this.isChangeable(key);
  }

  /** Whether an earlier frame is shown, from which a branch with another value of the key can continue. */
  isOfPast(key: string): boolean {
    return (this.live.standing?.looks_back ?? false) && this.isChangeable(key);
  }

  /** Changes a value; `make` makes it of the scenario on which it acts. */
  async change(key: string, make: () => Json): Promise<Answer | undefined> {
    const dragged = this.drag.end(key);
    if (this.isOfPast(key)) {
      const elsewhere = await this.actElsewhere(key, make);
      if (elsewhere) return elsewhere;
    }
    const value = make();
    const before = dragged ?? at(this.wanted(), key);
    const answer = await this.apply(key, value);
    const isMade = before !== undefined && !isSame(before, value) && !answer?.issues.length;
    if (isMade) this.undone.push({ before: [[key, before]], restarts: false });
    this.showUndo();
    return answer;
  }

  /** Asks where a change acts while an earlier time is shown; nothing if it acts now, to which it returns. */
  private async actElsewhere(key: string, make: () => Json): Promise<Answer | undefined> {
    const answer: Answer = { ...kept, issues: [] };
    const wanted = await askWhen(this.live);
    if (wanted === 'now') {
      await this.live.ask({ do: 'live' });
      return undefined;
    }
    try {
      if (wanted === 'branch') location.hash = `#/session/${await openBranch(this.live, [`${key}=${text(make())}`])}`;
    } catch (error) {
      answer.issues.push({ keys: [key], text: (error as Error).message });
    }
    this.rebuild(); // the value of this run is as before
    for (const one of this.form.fields) one.restore();
    this.showIssues(answer, [key]);
    return answer;
  }

  private isChangeable(key: string): boolean {
    return this.live.hello?.changeable.includes(key.split('.')[0] as string) ?? false;
  }

  /** Takes a value of a slider that is being dragged. What is refused meanwhile is said at the end of the drag. */
  private drags(key: string, value: Json): void {
    const { looks_back: isPast, ended } = this.live.standing ?? { looks_back: true, ended: true };
    if (this.isAtOnce(key) && !isPast && !ended) this.drag.move(key, value, at(this.wanted(), key));
  }

  /** Takes the last change back, by another one. */
  private async undo(): Promise<void> {
    const last = this.undone.pop(this.wanted());
    if (last?.restarts) {
      const settings = last.before.map(([key, value]) => `${key}=${text(value)}`);
      const answer = await this.beginAnew(combine(this.settings(), settings), '');
      if (answer.issues.length > 0) this.undone.push(last);
      this.showIssues(answer, settings.map(keyOf));
    } else {
      for (const one of last?.before ?? []) {
        const answer = await this.apply(...one);
        if (last && answer?.issues.length) this.undone.push(last);
      }
    }
    this.showUndo();
  }

  private showUndo(): void {
    const looksBack = this.live.standing?.looks_back ?? false; // then changes ask where they act
    this.undoButton.hidden = looksBack || !this.undone.has(this.wanted());
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
    this.tuned.keep(key, at(this.wanted(), key));
    void this.change(key, () => this.tuned.of(key, type) ?? { type });
  }

  /** Whether the entries of a list are moved; robots that are tracked one by one have no obstacles. */
  private hasMovers(key: string): boolean {
    return key === 'obstacles' && at(this.live.hello?.scenario, 'robots') == null;
  }

  /** Sets an object as published or not; values that a paper's method cannot have go back to their defaults. */
  private async preset(key: string, schema: Schema, isPublished: boolean): Promise<void> {
    const present = at(this.wanted(), key);
    if (!present || typeof present !== 'object' || Array.isArray(present)) return;
    const own = { ...differing(schema, present), as_published: isPublished, type: present['type'] ?? '' };
    const answer = await this.change(key, () => own);
    if (!answer?.issues.length || !isPublished) return;
    await this.change(key, () => without(key, own, answer.issues));
  }

  private wanted(): Scenario {
    return this.changes.wanted(this.live.hello?.scenario);
  }

  /** Shows the current values; the form is rebuilt only if its fields changed. */
  private rebuild(): void {
    const { hello } = this.live;
    if (!this.schema || !hello) return;
    const scenario = this.wanted();
    this.tuned.follow(this.seen, scenario);
    this.seen = scenario;
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
    this.showUndo();
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
    this.bar.show(this.changes.count);
  }
}
