// SPDX-License-Identifier: Apache-2.0
import { call } from './connection';
import { element } from './dom';
import { type Field, field } from './field';
import { number } from './numbers';
import type { Page } from './page';
import type { Json, Point } from './protocol';
import type { Schema } from './schema';
import { themeSwitch } from './theme';

/** A photograph that was sent to the lab. */
export interface Photograph {
  file: string;
  width_px: number;
  height_px: number;
  name: string;
  address: string; // of its bytes in the page
}

type Step = 'scale' | 'vessels' | 'places';
const steps: [Step, string][] = [
  ['scale', '1 Scale'],
  ['vessels', '2 Vessels'],
  ['places', '3 Start and goal'],
];
const hints: { [step in Step]: string } = {
  scale: 'Click two points whose distance you know, or type the µm per pixel. Keys: arrows and Enter on the photograph.',
  vessels: 'The outline shows the vessels that were found.',
  places: 'Click the start, then the goal; or gather robots where you click.',
};

const ways: { [key: string]: Point } = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

/** From a photograph to an experiment: scale, vessels, start and goal. */
export function photoPage(photo: Photograph): Promise<Page> {
  let step: Step = 'scale';
  let umPerPx = 1;
  let ruler: Point[] = [];
  let start: Point | undefined;
  let goal: Point | undefined;
  let cross: Point | undefined; // of those who use keys
  let gathers = false;
  const settings = new Map<string, Json>();
  const trouble = element('p', { class: 'trouble', role: 'alert' });
  const hint = element('p', { class: 'doc' });
  const found = element('output', { class: 'doc' });
  const image = element('img', { src: photo.address, alt: photo.name, class: 'photo' });
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('viewBox', `0 0 ${photo.width_px} ${photo.height_px}`);
  const picture = element(
    'div',
    { class: 'photo-frame', tabindex: '0', role: 'application', 'aria-label': 'Photograph: arrows move the cross, Enter sets the point' },
    image,
    svg,
  );
  picture.style.width = `min(100%, calc((100vh - 80px) * ${photo.width_px / photo.height_px}))`;
  const say = (error: Error) => (trouble.textContent = error.message);

  const scale = numeric('um-per-px', 'µm per pixel', umPerPx, (value) => (umPerPx = value));
  const length = numeric('distance', 'Distance of the two points in µm', 1000, () => measure());
  const robots = numeric('robots', 'Robots', 256, () => undefined);
  const measure = () => {
    const [a, b] = ruler;
    if (!a || !b) return;
    const pixels = Math.hypot(b[0] - a[0], b[1] - a[1]);
    if (pixels > 0) scale.set((umPerPx = length.get() / pixels));
  };

  const fields = element('div', { class: 'form' });
  let made: Field[] = [];
  void call<Schema>('GET', '/api/vessel-schema').then((schema) => {
    made = Object.entries(schema.properties ?? {}).map(([key, one]) => {
      settings.set(key, one.default ?? null);
      return field(key, one, (name, value) => {
        settings.set(name, value);
        made.find((other) => other.key === name)?.show(value);
        void search();
      });
    });
    for (const one of made) one.show(settings.get(one.key));
    fields.replaceChildren(...made.map((one) => one.root));
  }, say);
  const words = () => [...settings].filter(([, value]) => value !== null).map(([key, value]) => `${key}=${String(value)}`);

  let searches = false;
  let again = false;
  const search = async () => {
    if (searches) {
      again = true;
      return;
    }
    searches = true;
    do {
      again = false;
      const began = performance.now();
      const tell = () => (found.value = `Searching … ${Math.floor((performance.now() - began) / 1000)} s`);
      tell();
      const ticks = setInterval(tell, 1000);
      try {
        const response = await fetch('/api/vessels', {
          method: 'POST',
          body: JSON.stringify({ file: photo.file, settings: words() }),
        });
        if (!response.ok) throw new Error((await response.json()).error);
        clearInterval(ticks);
        const numbers = JSON.parse(response.headers.get('Microswarm-Vessels') ?? '{}');
        image.src = URL.createObjectURL(await response.blob());
        found.value = `Vessels cover ${number(100 * numbers.view_share, 3)} % of the view; wide ones are ${number(numbers.wide_width_px, 3)} px; ${number(100 * numbers.kept_share, 3)} % of ${numbers.pieces} pieces are kept.`;
        trouble.textContent = '';
      } catch (error) {
        found.value = '';
        say(error as Error);
      } finally {
        clearInterval(ticks);
      }
    } while (again);
    searches = false;
  };

  const draw = () => {
    svg.replaceChildren();
    const size = Math.max(photo.width_px, photo.height_px);
    const dot = ([x, y]: Point, label: string, kind: string) => {
      const circle = document.createElementNS(svg.namespaceURI as string, 'circle');
      for (const [name, value] of Object.entries({ cx: x, cy: y, r: size / 120, class: kind }))
        circle.setAttribute(name, String(value));
      const text = document.createElementNS(svg.namespaceURI as string, 'text');
      for (const [name, value] of Object.entries({ x: x + size / 80, y: y - size / 80, 'font-size': size / 40 }))
        text.setAttribute(name, String(value));
      text.textContent = label;
      (svg as unknown as SVGElement).append(circle, text);
    };
    if (cross && step !== 'vessels') {
      const line = document.createElementNS(svg.namespaceURI as string, 'path');
      const [x, y] = cross;
      const arm = size / 50;
      line.setAttribute('d', `M${x - arm} ${y}h${2 * arm}M${x} ${y - arm}v${2 * arm}`);
      line.setAttribute('class', 'cross');
      svg.append(line);
    }
    if (step === 'scale') ruler.forEach((one, i) => dot(one, i === 0 ? 'a' : 'b', 'ruler'));
    if (step !== 'places') return;
    if (start && !gathers) dot(start, 'start', 'start');
    if (goal) dot(goal, gathers ? 'gather here' : 'goal', 'goal');
  };
  const put = (at: Point) => {
    if (step === 'scale') {
      ruler = ruler.length === 2 ? [at] : [...ruler, at];
      measure();
    } else if (step === 'places') {
      if (gathers || (start && !goal)) goal = at;
      else {
        start = at;
        goal = undefined;
      }
      playButton.disabled = !goal;
    }
    draw();
  };
  picture.addEventListener('click', (event) => {
    const box = picture.getBoundingClientRect();
    cross = undefined;
    put([
      ((event.clientX - box.left) / box.width) * photo.width_px,
      ((event.clientY - box.top) / box.height) * photo.height_px,
    ]);
  });
  picture.addEventListener('keydown', (event) => {
    const way = ways[event.key];
    if (event.key !== 'Enter' && !way) return;
    event.preventDefault();
    cross ??= [photo.width_px / 2, photo.height_px / 2];
    if (way) {
      const length = (event.shiftKey ? 1 / 20 : 1 / 200) * Math.max(photo.width_px, photo.height_px);
      const within = (value: number, most: number) => Math.min(Math.max(value, 0), most);
      cross = [within(cross[0] + length * way[0], photo.width_px), within(cross[1] + length * way[1], photo.height_px)];
      draw();
    } else {
      put(cross);
    }
  });

  const toWorld = ([x, y]: Point): Point => [x * umPerPx, (photo.height_px - y) * umPerPx];
  const play = async () => {
    playButton.disabled = true;
    found.value = 'The experiment is being made …';
    try {
      const body = {
        file: photo.file,
        settings: words(),
        um_per_px: umPerPx,
        goal: toWorld(goal as Point),
        ...(gathers ? { robots: robots.get() } : { start: toWorld(start as Point) }),
      };
      const { file } = await call<{ file: string }>('POST', '/api/photographs', body);
      const { session } = await call<{ session: number }>('POST', '/api/sessions', { file, photo: photo.file, um_per_px: umPerPx });
      location.hash = `#/session/${session}`;
    } catch (error) {
      found.value = '';
      say(error as Error);
      playButton.disabled = false;
    }
  };
  const playButton = element('button', { type: 'button', class: 'primary', disabled: true, onclick: () => void play() }, 'Make the experiment');
  const gatherBox = element('input', {
    type: 'checkbox',
    role: 'switch',
    class: 'switch',
    onchange: () => {
      gathers = gatherBox.checked;
      start = goal = undefined;
      playButton.disabled = true;
      draw();
    },
  });
  const panels: { [one in Step]: HTMLElement } = {
    scale: element('div', {}, length.root, scale.root),
    vessels: fields,
    places: element(
      'div',
      {},
      element('label', { class: 'layer' }, gatherBox, 'Gather robots where I click'),
      robots.root,
      element('div', { class: 'row' }, playButton),
    ),
  };
  const buttons = steps.map(([name, label]) =>
    element('button', { type: 'button', 'data-step': name, onclick: () => go(name) }, label),
  );
  const next = element('button', { type: 'button', class: 'primary next', onclick: () => go(step === 'scale' ? 'vessels' : 'places') }, 'Next');
  let hasSearched = false;
  const go = (to: Step) => {
    if (!(umPerPx > 0)) return say(new Error('The µm per pixel must be above 0.'));
    trouble.textContent = '';
    step = to;
    buttons.forEach((one) => one.setAttribute('aria-pressed', String(one.dataset['step'] === to)));
    for (const [name] of steps) panels[name].hidden = name !== to;
    next.hidden = to === 'places';
    hint.textContent = hints[to];
    if (to !== 'scale' && !hasSearched) {
      hasSearched = true;
      void search();
    }
    draw();
  };
  const root = element(
    'div',
    { class: 'photo-page' },
    element(
      'header',
      { class: 'top' },
      element('a', { href: '#/', class: 'button quiet' }, '‹ Gallery'),
      element('h1', { class: 'title' }, photo.name),
      ...buttons,
      element('span', { class: 'spacer' }),
      themeSwitch(),
    ),
    element('div', { class: 'photo-stage' }, picture),
    element('aside', { class: 'photo-side' }, hint, trouble, ...Object.values(panels), element('div', { class: 'row' }, next), found),
  );
  go('scale');
  document.title = `${photo.name} – microswarm lab`;
  return Promise.resolve({ root, leave: () => undefined });
}

function numeric(name: string, label: string, value: number, change: (value: number) => void) {
  const id = `photo-${name}`;
  const entry = element('input', {
    id,
    type: 'number',
    class: 'number',
    step: 'any',
    min: '0',
    value: String(value),
    onchange: () => change(Number(entry.value)),
  });
  return {
    root: element('div', { class: 'row' }, element('label', { for: id }, label), entry),
    get: () => Number(entry.value),
    set: (to: number) => (entry.value = String(Number(to.toPrecision(5)))),
  };
}
