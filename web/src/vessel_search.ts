// SPDX-License-Identifier: Apache-2.0
import { call } from './connection';
import { element } from './dom';
import { type Field, field } from './field';
import { number } from './numbers';
import { showOutcome, showProgress } from './progress';
import type { Json } from './protocol';
import type { Schema } from './schema';

/** Search for the vessels of an uploaded photograph, with its parameters as a form. */
export class VesselSearch {
  readonly form = element('div', { class: 'form' });
  /** Result or progress of the search. */
  readonly found = element('output', { class: 'doc' });
  private readonly values = new Map<string, Json>();
  private fields: Field[] = [];
  private address = ''; // URL of the shown picture
  private has = false;
  private runs = false;
  private again = false;

  constructor(
    private readonly file: string,
    private readonly show: (address: string) => void,
    private readonly say: (trouble: string) => void,
  ) {
    void call<Schema>('GET', '/api/vessel-schema').then(
      (schema) => this.build(schema),
      (error: Error) => say(error.message),
    );
  }

  /** Its parameters as KEY=VALUE. */
  settings(): string[] {
    return [...this.values].filter(([, value]) => value !== null).map(([key, value]) => `${key}=${String(value)}`);
  }

  /** Starts the first search, unless done. */
  begin(): void {
    if (!this.has) void this.search();
  }

  private build(schema: Schema): void {
    this.fields = Object.entries(schema.properties ?? {}).map(([key, one]) => {
      this.values.set(key, one.default ?? null);
      return field(key, one, (name, value, drags) => {
        if (drags) return; // a search takes seconds
        this.values.set(name, value);
        this.fields.find((other) => other.key === name)?.show(value);
        void this.search();
      });
    });
    for (const one of this.fields) one.show(this.values.get(one.key));
    this.form.replaceChildren(...this.fields.map((one) => one.root));
  }

  /** Runs one search at a time; of several requests the last one counts. */
  private async search(): Promise<void> {
    this.has = true;
    this.again = this.runs;
    if (this.runs) return;
    this.runs = true;
    do {
      this.again = false;
      await this.once();
    } while (this.again);
    this.runs = false;
  }

  private async once(): Promise<void> {
    const began = performance.now();
    const tell = () => showProgress(this.found, `Searching … ${Math.floor((performance.now() - began) / 1000)} s`);
    showOutcome(this.found, 'Searching …');
    const ticks = setInterval(tell, 1000);
    try {
      const body = JSON.stringify({ file: this.file, settings: this.settings() });
      const response = await fetch('/api/vessels', { method: 'POST', body });
      if (!response.ok) throw new Error((await response.json()).error);
      URL.revokeObjectURL(this.address);
      this.address = URL.createObjectURL(await response.blob());
      this.show(this.address);
      showOutcome(this.found, described(JSON.parse(response.headers.get('Microswarm-Vessels') ?? '{}')));
      this.say('');
    } catch (error) {
      this.found.value = '';
      this.say((error as Error).message);
    } finally {
      clearInterval(ticks);
    }
  }
}

function described(found: { [name: string]: number } & { choice?: string }): string {
  const percent = (share: number | undefined) => `${number(100 * (share ?? 0), 3)} %`;
  return (
    `Vessels cover ${percent(found['view_share'])} of the view; wide ones are ${number(found['wide_width_px'] ?? 0, 3)} px; ` +
    `${percent(found['kept_share'])} of ${found['pieces']} pieces are kept. Method: ${found.choice ?? '?'}. ` +
    `A swarm fits into the tinted ones, ${percent(found['swarm_share'])} of their area.`
  );
}
