// SPDX-License-Identifier: Apache-2.0
import { call } from './connection';
import { element } from './dom';
import { type Field, field, menu } from './field';
import type { Live } from './live';
import { mayBeginAnew } from './loss';
import { words } from './numbers';
import { type Answer, type Issue, type Json, type Scenario, said } from './protocol';
import { type Schema, alternative, allowsNull, described, isGroup, kinds, withoutNull } from './schema';
import { at, combine, keyOf, text } from './settings';

const most = 40; // maximum number of entries shown of a list of groups
const last = ['name', 'description', 'map'];
const refused: Answer = {
  type: 'answer',
  id: 0,
  issues: [{ keys: [], text: 'This needs a new run: stop the rig first.' }],
};
const kept: Answer = { type: 'answer', id: 0, issues: [{ keys: [], text: 'The run continues.' }] };
const unfolded = ['goal_um', 'navigator'];

let schemaOnce: Promise<Schema> | undefined;

/** The scenario's parameters as a form made from its schema. */
export class Parameters {
  readonly root: HTMLElement;
  private schema: Schema | undefined;
  private fields: Field[] = [];
  private shape = '';
  private readonly open = new Set<string>(unfolded);
  private readonly waiting = new Map<string, Json>();
  private readonly asked = new Map<string, Json>(); // values sent, not yet confirmed
  private setting: Promise<unknown> = Promise.resolve(); // the last one sent
  private readonly form = element('div', { class: 'form' });
  private readonly search = element('input', {
    type: 'search',
    class: 'search',
    placeholder: 'Find a parameter',
    'aria-label': 'Find a parameter',
    oninput: () => this.filter(),
  });
  private readonly bar = element('div', { class: 'waiting', role: 'status', hidden: true });
  private readonly trouble = element('p', { class: 'issue', role: 'alert', hidden: true });

  constructor(private readonly live: Live) {
    this.root = element('div', { class: 'parameters' }, this.search, this.trouble, this.form, this.bar);
    let ended = false;
    live.listen((message) => {
      if (message.type === 'hello' || message.type === 'scenario') this.take(message.scenario);
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

  /** Restarts the experiment with all changes and `more` settings KEY=VALUE. */
  async restart(more: string[] = []): Promise<Answer> {
    await this.setting;
    const waiting = [...this.waiting].map(([key, value]) => `${key}=${text(value)}`);
    const settings = combine(
      this.live.hello?.settings ?? [],
      this.live.standing?.changes ?? [],
      waiting,
      more,
    );
    const isArmed = this.live.rig?.state === 'armed';
    if (!isArmed && !(await mayBeginAnew(this.live))) return kept;
    const answer = isArmed ? refused : await this.live.ask({ do: 'restart', settings });
    if (answer.issues.length === 0) this.waiting.clear();
    this.showIssues(answer, [...waiting, ...more].map(keyOf));
    this.showWaiting();
    return answer;
  }

  /** Settings of a session that starts in this one's current state. */
  settings(): string[] {
    const waiting = [...this.waiting].map(([key, value]) => `${key}=${text(value)}`);
    return combine(this.live.hello?.settings ?? [], this.live.standing?.changes ?? [], waiting);
  }

  /** Whether a key takes effect at the next tick, otherwise at a restart. */
  isAtOnce(key: string): boolean {
    const top = key.split('.')[0] as string;
    return !this.live.standing?.ended && (this.live.hello?.changeable.includes(top) ?? false);
  }

  async change(key: string, value: Json): Promise<Answer | undefined> {
    if (this.isAtOnce(key)) {
      const set = this.live.ask({ do: 'set', key, value: text(value) });
      this.setting = set;
      this.asked.set(key, value);
      const answer = await set;
      if (this.asked.get(key) === value) this.asked.delete(key);
      if (answer.issues.length === 0) this.rebuild();
      this.showIssues(answer, [key]);
      return answer;
    }
    const present = at(this.live.hello?.scenario, key);
    for (const one of [...this.waiting.keys()]) if (one.startsWith(`${key}.`)) this.waiting.delete(one);
    if (JSON.stringify(present) === JSON.stringify(value)) this.waiting.delete(key);
    else this.waiting.set(key, value);
    this.rebuild();
    return undefined;
  }

  private take(scenario: Scenario): void {
    for (const [key, value] of this.waiting)
      if (JSON.stringify(at(scenario, key)) === JSON.stringify(value)) this.waiting.delete(key);
    this.rebuild();
  }

  /** The scenario with pending and unconfirmed changes. */
  private wanted(): Scenario {
    const scenario = structuredClone(this.live.hello?.scenario ?? {});
    for (const [key, value] of [...this.waiting, ...this.asked]) {
      const names = key.split('.');
      const name = names.pop() as string;
      const parent = names.length > 0 ? at(scenario, names.join('.')) : scenario;
      if (parent && typeof parent === 'object') (parent as { [key: string]: Json })[name] = value;
    }
    return scenario;
  }

  /** Shows the current values; the form is rebuilt only if its fields changed. */
  private rebuild(): void {
    if (!this.schema || !this.live.hello) return;
    const scenario = this.wanted();
    const fields: Field[] = [];
    const made = element('div', { class: 'form' });
    const shape = JSON.stringify([shapeOf(scenario), this.live.standing?.ended]);
    if (shape !== this.shape) {
      const focus = (document.activeElement as HTMLElement | null)?.id;
      const properties = Object.entries(this.schema.properties ?? {});
      properties.sort(([a], [b]) => Number(last.includes(a)) - Number(last.includes(b)));
      for (const [key, schema] of properties)
        made.append(this.node(key, schema, scenario[key], fields));
      this.fields = fields;
      this.shape = shape;
      const scroll = this.root.scrollTop;
      this.form.replaceChildren(...made.childNodes);
      this.root.scrollTop = scroll;
      if (focus?.startsWith('field-')) document.getElementById(focus)?.focus();
      this.filter();
    }
    for (const one of this.fields) {
      one.show(at(scenario, one.key));
      one.setWaiting([...this.waiting.keys()].some((key) => key === one.key || one.key.startsWith(`${key}.`)));
      if (this.live.hello.playback) one.setEnabled(false);
    }
    this.showWaiting();
  }

  private node(key: string, schema: Schema, value: Json | undefined, fields: Field[]): HTMLElement {
    const inner = withoutNull(schema);
    if (inner.type === 'array' && inner.items && isGroup(inner.items)) return this.listNode(key, inner, value, fields);
    if (!isGroup(schema)) return this.fieldNode(key, schema, fields);
    const body: HTMLElement[] = [];
    if (value === null || value === undefined) {
      if (allowsNull(schema))
        body.push(element('p', { class: 'doc' }, 'None in this scenario.'));
    } else if (inner.oneOf) {
      body.push(this.kindNode(key, inner, fields));
      this.addProperties(body, key, alternative(inner, value), value, fields);
    } else {
      this.addProperties(body, key, inner, value, fields);
    }
    return this.group(key, described(schema).doc, body);
  }

  private addProperties(to: HTMLElement[], key: string, schema: Schema | undefined, value: Json, fields: Field[]): void {
    for (const [name, one] of Object.entries(schema?.properties ?? {}))
      if (name !== 'type') to.push(this.node(`${key}.${name}`, one, at(value, name), fields));
  }

  private fieldNode(key: string, schema: Schema, fields: Field[]): HTMLElement {
    const made = field(key, schema, (name, value) => void this.change(name, value));
    if (!key.includes('.')) made.root.prepend(this.badge(key));
    fields.push(made);
    return made.root;
  }

  /** Menu of an object's `type`; a new type gets its defaults. */
  private kindNode(key: string, schema: Schema, fields: Field[]): HTMLElement {
    const id = `field-${key}.type`;
    const control = menu(id, kinds(schema), (type) => void this.change(key, { type }));
    const issue = element('p', { class: 'issue', role: 'alert', hidden: true });
    const root = element(
      'div',
      { class: 'field', 'data-key': `${key}.type` },
      element('label', { for: id }, 'type'),
      element('div', { class: 'control' }, ...control.nodes),
      issue,
    );
    fields.push({
      key: `${key}.type`,
      root,
      text: `${key}.type ${kinds(schema).join(' ')}`.toLowerCase(),
      show: control.show,
      setIssue: (words) => {
        issue.hidden = words === '';
        issue.textContent = words;
        if (words !== '') control.show(at(this.wanted(), `${key}.type`));
      },
      setWaiting: (waits) => root.classList.toggle('waits', waits),
      setEnabled: (enabled) => root.querySelectorAll('select').forEach((one) => (one.disabled = !enabled)),
    });
    return root;
  }

  private listNode(key: string, schema: Schema, value: Json | undefined, fields: Field[]): HTMLElement {
    const entries = Array.isArray(value) ? value : [];
    const body = entries.slice(0, most).map((entry, i) => {
      const group = this.node(`${key}.${i}`, schema.items as Schema, entry, fields);
      const remove = element(
        'button',
        {
          type: 'button',
          class: 'remove',
          disabled: this.live.hello?.playback ?? false,
          onclick: () => void this.change(key, entries.filter((_, k) => k !== i)),
        },
        'Remove',
      );
      group.append(remove);
      return group;
    });
    if (entries.length === 0) body.push(element('p', { class: 'doc' }, 'None.'));
    if (entries.length > most)
      body.push(element('p', { class: 'doc' }, `The first ${most} of ${entries.length} are shown.`));
    return this.group(key, described(schema).doc, body);
  }

  private group(key: string, doc: string, body: HTMLElement[]): HTMLElement {
    const name = key.slice(key.lastIndexOf('.') + 1);
    const label = /^\d+$/.test(name) ? `${words(key.split('.').at(-2) ?? '').label} ${name}` : words(name).label;
    const root = element(
      'details',
      {
        class: 'group',
        'data-key': key,
        ontoggle: () => {
          if (this.search.value !== '') return;
          if (root.open) this.open.add(key);
          else this.open.delete(key);
        },
      },
      element('summary', {}, label, ...(key.includes('.') ? [] : [this.badge(key)])),
      ...(doc ? [element('p', { class: 'doc' }, doc)] : []),
      ...body,
    );
    root.open = this.open.has(key);
    return root;
  }

  private badge(key: string): HTMLElement {
    const now = this.isAtOnce(key);
    return element(
      'span',
      { class: now ? 'badge now' : 'badge', title: now ? 'Takes effect at the next tick' : 'Takes effect at a restart' },
      now ? 'at once' : 'restart',
    );
  }

  /** Shows the fields whose key or doc line has all words of the search, and opens their groups. */
  private filter(): void {
    const wanted = this.search.value.toLowerCase().split(/\s+/).filter((one) => one !== '');
    for (const one of this.fields) one.root.hidden = !wanted.every((word) => one.text.includes(word));
    for (const group of this.form.querySelectorAll('details')) {
      const has = group.querySelector('.field:not([hidden])') !== null;
      group.hidden = wanted.length > 0 && !has;
      group.open = wanted.length > 0 ? has : this.open.has(group.dataset['key'] ?? '');
    }
  }

  /** Shows each issue at its field, at the nearest enclosing group, or above the form. */
  private showIssues(answer: Answer, asked: string[]): void {
    for (const one of this.fields) one.setIssue('');
    const loose: Issue[] = [];
    for (const issue of answer.issues) {
      const keys = issue.keys.length > 0 ? issue.keys : asked;
      const found = keys.map((key) => this.fieldFor(key, asked)).find((one) => one !== undefined);
      if (found) found.setIssue(issue.keys.length > 0 ? issue.text : said({ ...answer, issues: [issue] }));
      else loose.push(issue);
    }
    this.trouble.hidden = loose.length === 0;
    this.trouble.textContent = said({ ...answer, issues: loose });
  }

  private fieldFor(key: string, asked: string[]): Field | undefined {
    const within = (one: string) => this.fields.find((other) => other.key === one);
    return (
      within(key) ??
      asked.filter((one) => one.startsWith(`${key}.`) || key.startsWith(`${one}.`)).map((one) => within(one) ?? within(`${one}.type`)).find((one) => one) ??
      within(`${key}.type`)
    );
  }

  private showWaiting(): void {
    const count = this.waiting.size;
    this.bar.hidden = count === 0;
    if (count === 0) return;
    this.bar.replaceChildren(
      element('span', {}, count === 1 ? 'One change takes effect after a restart.' : `${count} changes take effect after a restart.`),
      element('button', { type: 'button', class: 'primary restart', onclick: () => void this.restart() }, 'Restart'),
      element(
        'button',
        {
          type: 'button',
          class: 'discard',
          onclick: () => {
            this.waiting.clear();
            this.rebuild();
          },
        },
        'Discard',
      ),
    );
  }
}

/** Shape of a scenario's form: the types of its objects and the lengths of its lists. */
function shapeOf(value: Json): Json {
  if (Array.isArray(value)) return value.some((one) => one && typeof one === 'object') ? value.map(shapeOf) : 0;
  if (value === null || typeof value !== 'object') return value === null ? null : 0;
  return Object.fromEntries(
    Object.entries(value).map(([key, one]) => [key, key === 'type' ? one : shapeOf(one)]),
  );
}
