// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import type { Point } from './protocol';

/** A marked point of a photograph [px]. */
export interface Dot {
  at: Point;
  label: string;
  kind: 'ruler' | 'start' | 'goal';
}

const ways: { [key: string]: Point } = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

/** A photograph on which points are set: by clicks, or by a cross that is moved by keys. */
export class PhotoCanvas {
  readonly root: HTMLElement;
  private readonly image: HTMLImageElement;
  private readonly svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  private readonly size: number; // of the longer side
  private dots: Dot[] = [];
  private cross: Point | undefined;

  constructor(
    name: string,
    address: string,
    private readonly width: number,
    private readonly height: number,
    private readonly put: (at: Point) => void,
  ) {
    this.size = Math.max(width, height);
    this.image = element('img', { src: address, alt: name, class: 'photo' });
    this.svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
    const label = 'Photograph: arrows move the cross, Enter puts a point there';
    const attributes = { class: 'photo-frame', tabindex: '0', role: 'application', 'aria-label': label };
    this.root = element('div', attributes, this.image, this.svg);
    this.root.style.width = `min(100%, calc((100vh - 80px) * ${width / height}))`;
    this.root.addEventListener('click', (event) => this.click(event));
    this.root.addEventListener('keydown', (event) => this.press(event));
  }

  /** Shows another picture of the same size. */
  show(address: string): void {
    this.image.src = address;
  }

  mark(dots: Dot[]): void {
    this.dots = dots;
    this.draw();
  }

  private click(event: MouseEvent): void {
    const box = this.root.getBoundingClientRect();
    this.cross = undefined;
    this.put([
      ((event.clientX - box.left) / box.width) * this.width,
      ((event.clientY - box.top) / box.height) * this.height,
    ]);
  }

  private press(event: KeyboardEvent): void {
    const way = ways[event.key];
    if (event.key !== 'Enter' && !way) return;
    event.preventDefault();
    this.cross ??= [this.width / 2, this.height / 2];
    if (!way) return this.put(this.cross);
    const length = this.size / (event.shiftKey ? 20 : 200);
    const within = (value: number, most: number) => Math.min(Math.max(value, 0), most);
    const [x, y] = this.cross;
    this.cross = [within(x + length * way[0], this.width), within(y + length * way[1], this.height)];
    this.draw();
  }

  private draw(): void {
    this.svg.replaceChildren();
    const { size } = this;
    for (const { at, label, kind } of this.dots) {
      const [x, y] = at;
      this.add('circle', { cx: x, cy: y, r: size / 120, class: kind });
      this.add('text', { x: x + size / 80, y: y - size / 80, 'font-size': size / 40 }).textContent = label;
    }
    if (!this.cross) return;
    const [x, y] = this.cross;
    const arm = size / 50;
    this.add('path', { d: `M${x - arm} ${y}h${2 * arm}M${x} ${y - arm}v${2 * arm}`, class: 'cross' });
  }

  private add(name: string, attributes: { [name: string]: string | number }): Element {
    const made = document.createElementNS(this.svg.namespaceURI, name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
    return this.svg.appendChild(made);
  }
}
