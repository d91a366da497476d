// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import type { Point } from './protocol';
import type { Said } from './scene/key';
import type { Scene } from './scene/scene';

const period = 100; // ms between looks while the picture moves
const away = 16; // from the pointer [px]

/** Says what is under the pointer, at a tap, or at the middle of the view. */
export function hoverTip(scene: Scene): { root: HTMLElement; sayMiddle: () => void; destroy: () => void } {
  const root = element('div', { class: 'hover', role: 'status', hidden: true });
  let at: Point | undefined;
  let shown = '';
  let looked = 0;
  const end = new AbortController();
  const show = () => {
    looked = performance.now();
    const said = at && scene.say(at);
    root.hidden = !said;
    if (!said || !at) return;
    const text = JSON.stringify(said);
    if (text !== shown) root.replaceChildren(...nodesOf(said));
    shown = text;
    const [x, y] = placeOf(at, [root.offsetWidth, root.offsetHeight], [scene.view.width, scene.view.height]);
    root.style.transform = `translate(${x}px, ${y}px)`;
  };
  const point = (to: Point | undefined) => {
    at = to;
    show();
  };
  const { signal } = end;
  const listen = (name: 'pointermove' | 'pointerdown', act: (event: PointerEvent) => void) =>
    scene.root.addEventListener(name, act, { signal });
  listen('pointermove', (event) => {
    if (event.pointerType === 'touch') return; // what a tap said stays
    point(event.buttons === 0 ? placeIn(scene.root, event) : undefined);
  });
  listen('pointerdown', (event) => point(event.pointerType === 'touch' ? placeIn(scene.root, event) : undefined));
  scene.root.addEventListener('pointerleave', (event) => event.pointerType !== 'touch' && point(undefined), { signal });
  scene.onPicture(() => {
    if (at && performance.now() > looked + period) show();
  });
  return {
    root,
    sayMiddle: () => {
      const middle: Point = [scene.view.width / 2, scene.view.height / 2];
      point(at && String(at) === String(middle) ? undefined : middle);
      if (at && !scene.say(at)) {
        root.replaceChildren('Nothing is at the middle of the view: follow the swarm (l), or move the map.');
        shown = '';
        root.hidden = false;
      }
    },
    destroy: () => end.abort(),
  };
}

function nodesOf({ title, lines }: Said): Node[] {
  return [element('strong', {}, title), ...lines.map((one) => element('span', {}, one))];
}

function placeIn(root: HTMLElement, event: PointerEvent): Point {
  const { left, top } = root.getBoundingClientRect();
  return [event.clientX - left, event.clientY - top];
}

/** Upper left corner of a box beside a point, within a screen. */
export function placeOf([x, y]: Point, [width, height]: Point, [right, bottom]: Point): Point {
  const beside = x + away + width <= right ? x + away : x - away - width;
  const below = y + away + height <= bottom ? y + away : y - away - height;
  return [Math.max(0, Math.min(beside, right - width)), Math.max(0, below)];
}
