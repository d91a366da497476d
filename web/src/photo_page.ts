// SPDX-License-Identifier: Apache-2.0
import { call } from './connection';
import { element } from './dom';
import { numberEntry } from './number_entry';
import type { Page } from './page';
import { type Dot, PhotoCanvas } from './photo_canvas';
import type { Point } from './protocol';
import { themeSwitch } from './theme';
import { VesselSearch } from './vessel_search';

/** A photograph that was uploaded. */
export interface Photograph {
  file: string;
  width_px: number;
  height_px: number;
  name: string;
  address: string; // URL of its bytes in the page
}

type Step = 'scale' | 'vessels' | 'places';
const steps: [Step, string][] = [
  ['scale', '1 Scale'],
  ['vessels', '2 Vessels'],
  ['places', '3 Start and goal'],
];
const hints: { [step in Step]: string } = {
  scale: 'Click two points of known distance, or type the µm per pixel. Keys: arrows and Enter on the photograph.',
  vessels: 'The outline shows the vessels found. Start and goal of a swarm are in the tinted ones.',
  places: 'Click the start, then the goal, both in tinted vessels, or gather robots at a click.',
};

/** From a photograph to an experiment: scale, vessels, start and goal. */
class PhotoPage {
  readonly root: HTMLElement;
  private readonly trouble = element('p', { class: 'trouble', role: 'alert' });
  private readonly hint = element('p', { class: 'doc' });
  private readonly canvas: PhotoCanvas;
  private readonly vessels: VesselSearch;
  private readonly scale = this.numeric('um-per-px', 'µm per pixel', 1);
  private readonly length = this.numeric('distance', 'Distance of the two points in µm', 1000, () => this.measure());
  private readonly robots = this.numeric('robots', 'Robots', 256);
  private readonly gather = element('input', {
    type: 'checkbox',
    role: 'switch',
    class: 'switch',
    onchange: () => this.begin(),
  });
  private readonly make = element(
    'button',
    { type: 'button', class: 'primary', disabled: true, onclick: () => void this.play() },
    'Make the experiment',
  );
  private readonly next = element(
    'button',
    { type: 'button', class: 'primary next', onclick: () => this.go(this.step === 'scale' ? 'vessels' : 'places') },
    'Next',
  );
  private readonly buttons: HTMLButtonElement[];
  private readonly panels: { [step in Step]: HTMLElement };
  private step: Step = 'scale';
  private ruler: Point[] = [];
  private start: Point | undefined;
  private goal: Point | undefined;

  constructor(private readonly photo: Photograph) {
    const { name, address, width_px: width, height_px: height } = photo;
    this.canvas = new PhotoCanvas(name, address, width, height, (at) => this.put(at));
    this.vessels = new VesselSearch(
      photo.file,
      (picture) => this.canvas.show(picture),
      (text) => this.say(text),
    );
    this.panels = {
      scale: element('div', {}, this.length.root, this.scale.root),
      vessels: this.vessels.form,
      places: element(
        'div',
        {},
        element('label', { class: 'layer' }, this.gather, 'Gather robots at the click'),
        this.robots.root,
        element('div', { class: 'row' }, this.make),
      ),
    };
    this.buttons = steps.map(([step, label]) =>
      element('button', { type: 'button', 'data-step': step, onclick: () => this.go(step) }, label),
    );
    this.root = element(
      'div',
      { class: 'photo-page' },
      element(
        'header',
        { class: 'top' },
        element('a', { href: '#/', class: 'button quiet' }, '‹ Gallery'),
        element('h1', { class: 'title' }, name),
        ...this.buttons,
        element('span', { class: 'spacer' }),
        themeSwitch(),
      ),
      element('div', { class: 'photo-stage' }, this.canvas.root),
      element(
        'aside',
        { class: 'photo-side' },
        this.hint,
        element('div', { class: 'row' }, this.next, this.vessels.found),
        this.trouble,
        ...Object.values(this.panels),
      ),
    );
    this.go('scale');
  }

  private numeric(name: string, label: string, value: number, change: () => void = () => undefined) {
    const id = `photo-${name}`;
    const entry = numberEntry({ id }, change, (trouble) => this.say(trouble));
    entry.set(value);
    return {
      root: element('div', { class: 'row' }, element('label', { for: id }, label), entry.root),
      get: () => entry.get() ?? 0,
      set: (to: number) => entry.set(Number(to.toPrecision(5))),
    };
  }

  /** Makes a further experiment possible. */
  returned(): void {
    this.make.disabled = !this.goal;
  }

  readonly say = (text: string): void => {
    this.trouble.textContent = text;
  };

  private go(to: Step): void {
    if (!(this.scale.get() > 0)) return this.say('The µm per pixel must be above 0.');
    this.say('');
    this.step = to;
    this.buttons.forEach((one) => one.setAttribute('aria-pressed', String(one.dataset['step'] === to)));
    for (const [name] of steps) this.panels[name].hidden = name !== to;
    this.next.hidden = to === 'places';
    this.hint.textContent = hints[to];
    if (to !== 'scale') this.vessels.begin();
    this.mark();
  }

  private put(at: Point): void {
    if (this.step === 'scale') {
      this.ruler = this.ruler.length === 2 ? [at] : [...this.ruler, at];
      this.measure();
    } else if (this.step === 'places') {
      if (this.gather.checked || (this.start && !this.goal)) this.goal = at;
      else this.begin(at);
      this.make.disabled = !this.goal;
    }
    this.mark();
  }

  /** Clears start and goal, or sets a new start. */
  private begin(start?: Point): void {
    this.start = start;
    this.goal = undefined;
    this.make.disabled = true;
    this.mark();
  }

  private mark(): void {
    this.canvas.mark(this.dots());
  }

  private dots(): Dot[] {
    if (this.step === 'scale') return this.ruler.map((at, i) => ({ at, label: i === 0 ? 'a' : 'b', kind: 'ruler' }));
    const dots: Dot[] = [];
    if (this.step === 'vessels') return dots;
    if (this.start) dots.push({ at: this.start, label: 'start', kind: 'start' });
    if (this.goal) dots.push({ at: this.goal, label: this.gather.checked ? 'gather here' : 'goal', kind: 'goal' });
    return dots;
  }

  private measure(): void {
    const [a, b] = this.ruler;
    if (!a || !b) return;
    const pixels = Math.hypot(b[0] - a[0], b[1] - a[1]);
    if (pixels > 0) this.scale.set(this.length.get() / pixels);
  }

  private toWorld([x, y]: Point): Point {
    const scale = this.scale.get();
    return [x * scale, (this.photo.height_px - y) * scale];
  }

  private async play(): Promise<void> {
    this.make.disabled = true;
    this.vessels.found.value = 'Making the experiment …';
    const scale = this.scale.get();
    try {
      const { file } = await call<{ file: string }>('POST', '/api/photographs', {
        file: this.photo.file,
        settings: this.vessels.settings(),
        um_per_px: scale,
        goal: this.toWorld(this.goal as Point),
        ...(this.gather.checked ? { robots: this.robots.get() } : { start: this.toWorld(this.start as Point) }),
      });
      const opened = { file, photo: this.photo.file, um_per_px: scale };
      const { session } = await call<{ session: number }>('POST', '/api/sessions', opened);
      this.vessels.found.value = '';
      location.hash = `#/session/${session}`;
    } catch (error) {
      this.vessels.found.value = '';
      this.say((error as Error).message);
      this.make.disabled = false;
    }
  }
}

let last: { photo: Photograph; page: PhotoPage } | undefined;

/** Page of a photograph. One that is come back to is as it was left. */
export function photoPage(photo: Photograph): Promise<Page> {
  document.title = `${photo.name} – microswarm lab`;
  if (last?.photo !== photo) last = { photo, page: new PhotoPage(photo) };
  const { root, say } = last.page;
  last.page.returned();
  return Promise.resolve({ root, say, leave: () => undefined });
}
