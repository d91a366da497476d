// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import { type Field, field, menu } from './field';
import { words } from './numbers';
import { presets } from './preset';
import type { Json, Scenario } from './protocol';
import { type Schema, alternative, allowsNull, described, isGroup, kinds, withoutNull } from './schema';
import { at } from './settings';

const most = 40; // maximum number of entries shown of a list of groups
const last = ['name', 'description', 'map'];
const unfolded = ['goal_um', 'navigator'];

/** Owner of a form: its scenario, and the effects of changes. */
export interface FormOwner {
  /** The scenario as the form shows it. */
  wanted(): Scenario;
  change(key: string, value: Json, drags?: boolean): void;
  /** Changes the type of the object at a key. */
  changeType(key: string, type: string): void;
  /** Makes the object at a key as published, or with the program's additions. */
  preset(key: string, schema: Schema, isPublished: boolean): void;
  isAtOnce(key: string): boolean;
  canChange(): boolean;
  /** Further controls of a list of groups, and of one of its entries. */
  listTools(key: string): HTMLElement[];
  entryTools(key: string, index: number): HTMLElement[];
}

/** A scenario as a form made from its schema: groups that fold, with a field for each value. */
export class Form {
  readonly root = element('div', { class: 'form' });
  fields: Field[] = [];
  private readonly open = new Set<string>(unfolded);
  private isFiltered = false;
  private reach = Infinity;

  /** `name` is the form's own in its page. */
  constructor(
    private readonly owner: FormOwner,
    private readonly name: string,
  ) {}

  /** Makes all fields again; focus and scroll position stay. `reach`: the largest length that makes sense [µm]. */
  build(schema: Schema, scenario: Scenario, reach: number): void {
    this.reach = reach;
    const focus = this.root.contains(document.activeElement) ? document.activeElement?.id : undefined;
    const properties = Object.entries(schema.properties ?? {});
    properties.sort(([a], [b]) => Number(last.includes(a)) - Number(last.includes(b)));
    const fields: Field[] = [];
    const made = properties.map(([key, one]) => this.node(key, one, scenario[key], fields));
    this.fields = fields;
    const { scrollTop } = this.root;
    this.root.replaceChildren(...made);
    this.root.scrollTop = scrollTop;
    if (focus) document.getElementById(focus)?.focus();
  }

  /** Shows the fields that have all these words, and opens their groups. */
  filter(wanted: string[]): void {
    this.isFiltered = wanted.length > 0;
    for (const one of this.fields) one.root.hidden = !wanted.every((word) => one.text.includes(word));
    for (const group of this.root.querySelectorAll('details')) {
      const has = group.querySelector('.field:not([hidden])') !== null;
      group.hidden = this.isFiltered && !has;
      group.open = this.isFiltered ? has : this.open.has(group.dataset['key'] ?? '');
    }
  }

  /** Shows mistakes by field, none at the others, and brings the first into view. */
  showIssues(issues: Map<string, string>): void {
    let first: HTMLElement | undefined;
    for (const one of this.fields) {
      const text = issues.get(one.key) ?? '';
      one.setIssue(text);
      if (text !== '') first ??= one.root;
    }
    for (let group = first?.closest('details'); group; group = group.parentElement?.closest('details'))
      group.open = true;
    first?.scrollIntoView({ block: 'nearest' });
  }

  private node(key: string, schema: Schema, value: Json | undefined, fields: Field[]): HTMLElement {
    const inner = withoutNull(schema);
    if (inner.type === 'array' && inner.items && isGroup(inner.items)) return this.listNode(key, inner, value, fields);
    if (!isGroup(schema)) return this.fieldNode(key, schema, fields);
    const body: HTMLElement[] = [];
    if (value === null || value === undefined) {
      if (allowsNull(schema)) body.push(element('p', { class: 'doc' }, 'None in this scenario.'));
    } else if (inner.oneOf) {
      body.push(this.kindNode(key, inner, fields));
      const kind = alternative(inner, value);
      if (kind?.properties?.['as_published']) {
        const made = presets(key, (isPublished) => this.owner.preset(key, kind, isPublished));
        body.push(made.root);
        fields.push(made);
      }
      this.addProperties(body, key, kind, value, fields);
    } else {
      this.addProperties(body, key, inner, value, fields);
    }
    return this.group(key, described(schema).doc, body);
  }

  private addProperties(
    to: HTMLElement[],
    key: string,
    schema: Schema | undefined,
    value: Json,
    fields: Field[],
  ): void {
    for (const [name, one] of Object.entries(schema?.properties ?? {}))
      if (name !== 'type') to.push(this.node(`${key}.${name}`, one, at(value, name), fields));
  }

  private fieldNode(key: string, schema: Schema, fields: Field[]): HTMLElement {
    const made = field(
      key,
      schema,
      (name, value, drags) => this.owner.change(name, value, drags),
      this.name,
      this.reach,
    );
    if (!key.includes('.')) made.root.prepend(this.badge(key));
    fields.push(made);
    return made.root;
  }

  /** Menu of an object's `type`; a new type gets its defaults. */
  private kindNode(key: string, schema: Schema, fields: Field[]): HTMLElement {
    const id = `${this.name}-${key}.type`;
    const control = menu(id, kinds(schema), (type) => this.owner.changeType(key, String(type)));
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
      restore: () => undefined, // each show does
      setIssue: (words) => {
        issue.hidden = words === '';
        issue.textContent = words;
        if (words !== '') control.show(at(this.owner.wanted(), `${key}.type`));
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
          disabled: !this.owner.canChange(),
          onclick: () =>
            this.owner.change(
              key,
              entries.filter((_, k) => k !== i),
            ),
        },
        'Remove',
      );
      group.append(
        element('div', { class: 'row' }, ...(this.owner.canChange() ? this.owner.entryTools(key, i) : []), remove),
      );
      return group;
    });
    if (entries.length === 0) body.push(element('p', { class: 'doc' }, 'None.'));
    if (entries.length > most)
      body.push(element('p', { class: 'doc' }, `The first ${most} of ${entries.length} are shown.`));
    const tools = this.owner.canChange() ? this.owner.listTools(key) : [];
    if (tools.length > 0) body.push(element('div', { class: 'row' }, ...tools));
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
          if (this.isFiltered) return;
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
    const now = this.owner.isAtOnce(key);
    return element(
      'span',
      {
        class: now ? 'badge now' : 'badge',
        title: now ? 'Takes effect at the next tick' : 'Takes effect at a restart',
      },
      now ? 'at once' : 'restart',
    );
  }
}
