// SPDX-License-Identifier: Apache-2.0
import 'pixi.js/unsafe-eval'; // the page's policy forbids eval
import { AccessibilitySystem, Container, WebGLRenderer, extensions, loadEnvironmentExtensions } from 'pixi.js';
import { type Palette, type Theme, palettes, preferredTheme } from '../palette';
import type { Message, Point, Request } from '../protocol';
import { ringsOf } from './draw';
import { hitMark, hitObstacle } from './hit';
import { type Entry, type Said, kept } from './key';
import type { Drawing, Layer } from './layer';
import { type Moment, Motion } from './motion';
import { type Grip, Pointer, type Touch } from './pointer';
import { layerStack } from './stack';
import { View } from './view';

export type { Touch } from './pointer';

const nearRadius = 45; // of a swarm that is followed, at least [px]

/** The map and the moving objects, drawn from the stream only. World coordinates are µm, y up. */
export class Scene {
  readonly root = document.createElement('div');
  readonly view = new View();
  /** Number of pictures drawn. */
  pictures = 0;

  private readonly stage = new Container();
  private readonly world = new Container();
  private readonly motion = new Motion();
  private readonly stack = layerStack(() => this.pictureCame());
  private readonly listed = this.stack.listed;
  private readonly all: Layer[] = [this.stack.ground, ...this.listed, this.stack.ghost];
  private readonly stale = new Set<Layer>(this.all);
  private readonly touchListeners: ((touch: Touch) => void)[] = [];
  private readonly wantListeners: ((request: Request) => void)[] = [];
  private readonly followListeners: ((follows: boolean) => void)[] = [];
  private readonly showListeners: (() => void)[] = [];
  private readonly pictureListeners: (() => void)[] = [];
  private seen = new Map<string, Entry>(); // entries of the legend so far
  private readonly sizes = new ResizeObserver(() => this.resize());
  private colours: Palette = palettes[preferredTheme()];
  private requested = 0;
  private plays = false;
  private isRecord = false;
  private follows = false;
  private readonly pointer: Pointer;
  private isGone = false;
  private unwatchDensity = () => undefined as void;
  private hasCamera = false;

  static async create(): Promise<Scene> {
    await loadEnvironmentExtensions(false);
    extensions.remove(AccessibilitySystem); // after a press of Tab its element covers the canvas
    const renderer = new WebGLRenderer();
    const init = renderer.init({
      antialias: true,
      autoDensity: true,
      resolution: window.devicePixelRatio,
      eventMode: 'none',
      eventFeatures: { move: false, globalMove: false, click: false, wheel: false },
    });
    await init.catch((error: Error) => {
      const hasNone = !document.createElement('canvas').getContext('webgl2');
      throw hasNone
        ? new Error(
            'This browser has no WebGL 2, with which the lab draws: use another, or one with graphics acceleration.',
          )
        : error;
    });
    return new Scene(renderer);
  }

  private constructor(private readonly renderer: WebGLRenderer) {
    this.root.className = 'scene';
    this.root.append(renderer.canvas);
    renderer.canvas.style.display = 'block';
    this.describe('Map');
    this.stage.addChild(this.world);
    for (const layer of this.all) this.world.addChild(layer.world);
    for (const layer of this.all) this.stage.addChild(layer.screen);
    this.pointer = new Pointer(renderer.canvas, {
      view: this.view,
      hit: (screen) => this.hit(screen),
      touch: (touch) => this.touch(touch),
      viewChanged: () => this.viewChanged(),
      panned: () => this.follow(false),
    });
    this.sizes.observe(this.root);
    this.watchDensity();
    this.setTheme(preferredTheme());
  }

  destroy(): void {
    this.isGone = true;
    cancelAnimationFrame(this.requested);
    this.sizes.disconnect();
    this.unwatchDensity();
    this.pointer.destroy(); // Pixi's shared geometries keep the canvas
    this.stage.destroy({ children: true });
    this.renderer.view.texture.destroy(true); // else a cache of Pixi keeps the canvas
    this.renderer.destroy(true);
  }

  take(message: Message): void {
    if (message.type === 'hello') {
      this.motion.reset();
      this.seen = new Map();
      this.isRecord = message.playback;
      this.view.showMap(message.map.lo, message.map.hi);
      this.viewChanged();
    } else if (message.type === 'standing') {
      this.plays = message.plays;
      if (!this.plays) this.motion.settle();
      this.changed('motion');
    } else if (message.type === 'frame') {
      this.motion.take(message, performance.now(), this.plays);
      for (const layer of this.stack.followers) layer.follow(this.motion.newest);
      this.changed('motion');
    }
    for (const layer of this.all) if (layer.take(message)) this.stale.add(layer);
    this.ask();
    this.schedule();
  }

  /** Says to those who do not see the canvas what it shows. */
  describe(text: string): void {
    this.renderer.canvas.setAttribute!('role', 'img');
    this.renderer.canvas.setAttribute!('aria-label', text);
  }

  /** Shows the whole map. */
  fit(): void {
    this.follow(false);
    this.view.fit();
    this.viewChanged();
  }

  /** Keeps so many pixels at the top free when the map is fitted, where the scene is covered. */
  keepFree(top: number): void {
    this.view.head = top;
    this.resize();
  }

  zoomBy(factor: number): void {
    this.view.zoom(factor, [this.view.width / 2, this.view.height / 2]);
    this.viewChanged();
  }

  /** Centres the swarm, or the robots' mean, until the view is moved or fitted. */
  follow(on: boolean): void {
    if (on === this.follows) return;
    this.follows = on;
    const { swarm } = this.motion.newest;
    if (on && swarm && this.view.isWhole) this.view.enlarge(nearRadius / swarm.radius);
    this.changed('zoom');
    for (const listener of this.followListeners) listener(on);
    this.schedule();
  }

  onFollow(listener: (follows: boolean) => void): void {
    this.followListeners.push(listener);
  }

  /** The layers that this experiment has, with what they had in the legend so far. */
  layers(): { name: string; label: string; help: string; shown: boolean; entries: Entry[] }[] {
    this.seen = kept(
      this.seen,
      this.listed.map((layer) => layer.entries(this.colours)),
    );
    const has = (layer: Layer) =>
      layer === this.stack.camera ? this.hasCamera : layer === this.stack.background && this.stack.background.isThere;
    return this.listed.flatMap((layer, i) => {
      const entries = [...this.seen].filter(([key]) => key.startsWith(`${i} `)).map(([, entry]) => entry);
      if (entries.length === 0 && !layer.isEverywhere && !has(layer)) return [];
      const { name, label, help, shown } = layer;
      return [{ name, label, help, shown, entries }];
    });
  }

  /** Words on what is at a place on the screen. */
  say(screen: Point): Said | undefined {
    for (const layer of [...this.listed].reverse()) {
      const said = layer.shown ? layer.say(screen, this.drawing(performance.now())) : undefined;
      if (said) return said;
    }
    return undefined;
  }

  /** Makes lines, marks and texts larger by a factor. */
  setBold(factor: number): void {
    this.view.bold = factor;
    for (const layer of this.all) this.stale.add(layer);
    this.schedule();
  }

  /** Registers a listener of every picture drawn. */
  onPicture(listener: () => void): void {
    this.pictureListeners.push(listener);
  }

  show(name: string, on: boolean): void {
    for (const layer of this.listed) {
      if (layer.name !== name) continue;
      layer.shown = on;
      this.stale.add(layer);
    }
    if (name === 'background' || name === 'camera') this.drawAnew('walls');
    for (const listener of this.showListeners) listener();
    this.ask();
    this.schedule();
  }

  /** Registers a listener of layers that are shown or hidden. */
  onShow(listener: () => void): void {
    this.showListeners.push(listener);
  }

  setTheme(theme: Theme): void {
    this.colours = palettes[theme];
    this.seen = new Map();
    this.renderer.background.color = this.colours.ground;
    for (const layer of this.all) this.stale.add(layer);
    this.schedule();
    if (matchMedia('print').matches) this.paint(performance.now()); // paper does not wait for the next picture
  }

  /** Shows a background picture with its lower left corner at `lo` [µm]; none for an empty address. */
  async setBackground(url: string, lo: Point, umPerPx: number): Promise<void> {
    await this.stack.background.set(url, lo, umPerPx);
    this.drawAnew('walls');
    this.schedule();
  }

  onTouch(listener: (touch: Touch) => void): void {
    this.touchListeners.push(listener);
  }

  /** Requests of visible layers to the session. */
  onWant(listener: (request: Request) => void): void {
    this.wantListeners.push(listener);
    this.ask();
  }

  /** The current view with its time, as a PNG. */
  picture(): Promise<Blob> {
    return this.withClock(
      () =>
        new Promise((resolve, reject) =>
          this.renderer.canvas.toBlob!((blob) => (blob ? resolve(blob) : reject(new Error('no picture')))),
        ),
    );
  }

  /** Calls a function with a picture that shows the time. */
  private withClock<T>(act: () => T): T {
    const { shown } = this.stack.clock;
    const paint = (clock: boolean) => {
      this.stack.clock.shown = clock;
      this.stale.add(this.stack.clock);
      this.paint(performance.now());
    };
    paint(true);
    try {
      return act();
    } finally {
      paint(shown);
    }
  }

  /** Moving objects as shown at a time of performance.now(). */
  shownAt(now: number): Moment {
    return this.motion.at(now);
  }

  /** Called after a camera's picture was decoded. */
  private pictureCame(): void {
    if (!this.hasCamera) this.drawAnew('walls');
    this.hasCamera = true;
    this.schedule();
  }

  private ask(): void {
    if (this.wantListeners.length === 0) return;
    for (const layer of this.listed) {
      const request = layer.shown ? layer.wants() : undefined;
      if (request) for (const listener of this.wantListeners) listener(request);
    }
  }

  private changed(occasion: 'zoom' | 'motion'): void {
    for (const layer of this.all) if (layer.occasions[occasion]) this.stale.add(layer);
  }

  private drawAnew(name: string): void {
    for (const layer of this.listed) if (layer.name === name) this.stale.add(layer);
  }

  private viewChanged(): void {
    this.changed('zoom');
    this.schedule();
  }

  private resize(): void {
    if (this.isGone) return;
    const { clientWidth, clientHeight } = this.root;
    this.renderer.resize(clientWidth, clientHeight, window.devicePixelRatio);
    this.view.resize(clientWidth, clientHeight);
    this.viewChanged();
    this.paint(performance.now()); // a resized canvas is blank
  }

  /** Adapts to a screen of another pixel density. */
  private watchDensity(): void {
    if (this.isGone) return;
    const density = matchMedia(`(resolution: ${window.devicePixelRatio}dppx)`);
    const moved = () => {
      this.resize();
      this.watchDensity();
    };
    density.addEventListener('change', moved, { once: true });
    this.unwatchDensity = () => density.removeEventListener('change', moved);
  }

  private schedule(): void {
    if (this.requested || this.isGone) return;
    this.requested = requestAnimationFrame((now) => {
      this.requested = 0;
      this.paint(now);
    });
  }

  private paint(now: number): void {
    if (this.isGone) return;
    const isMoving = this.motion.isMoving(now);
    if (isMoving) this.changed('motion');
    const drawing = this.drawing(now);
    if (this.follows) this.centre(drawing);
    this.world.position.set(...this.view.origin);
    this.world.scale.set(this.view.scale, -this.view.scale);
    for (const layer of this.all) {
      layer.world.visible = layer.screen.visible = layer.shown;
      layer.world.alpha = layer.isSeenThrough && this.stack.camera.isSet ? 0.45 : 1;
      if (!layer.shown) continue;
      if (this.stale.delete(layer)) layer.draw(drawing);
      layer.place(drawing);
    }
    this.renderer.render(this.stage);
    ++this.pictures;
    for (const listener of this.pictureListeners) listener();
    if (isMoving) {
      this.changed('motion'); // the last picture shows the newest frame itself
      this.schedule();
    }
  }

  private drawing(now: number): Drawing {
    return { view: this.view, now: this.motion.at(now), colours: this.colours };
  }

  private centre({ now: { swarm, robots } }: Drawing): void {
    if (swarm) return this.view.centre([swarm.x, swarm.y]);
    let [x, y] = [0, 0];
    for (let i = 0; i < robots.length; i += 2) {
      x += robots[i]!;
      y += robots[i + 1]!;
    }
    if (robots.length > 0) this.view.centre([(2 * x) / robots.length, (2 * y) / robots.length]);
  }

  /** The object at a place on the screen. */
  hit(screen: Point): { what: Grip; place?: Point } {
    const map = { what: { kind: 'map' } as const };
    if (this.isRecord) return map;
    const mark =
      hitMark('goal', this.stack.goal.places, this.view, screen) ??
      hitMark('start', this.stack.start.places, this.view, screen);
    if (mark) return mark;
    const obstacle = hitObstacle(this.motion.newest, this.view, screen);
    return obstacle ? { what: obstacle } : map;
  }

  private touch(touch: Touch): void {
    const { phase, what, from, at } = touch;
    if (phase === 'begin' && what.kind !== 'map') this.hold(what, from);
    if (phase === 'end') this.stack.ghost.hold(undefined);
    else this.stack.ghost.move(at[0] - from[0], at[1] - from[1]);
    if (phase !== 'move') this.stale.add(this.stack.ghost);
    this.schedule();
    for (const listener of this.touchListeners) listener(touch);
  }

  private hold({ kind, index }: Grip, from: Point): void {
    const { discs, solids } = this.motion.newest;
    const own = discs.filter((_, i) => discs[i - (i % 4) + 3] === index);
    const bodies = ringsOf(
      own,
      solids.filter(({ number }) => number === index),
      this.view,
    );
    this.stack.ghost.hold(kind === 'obstacle' ? { kind, bodies } : { kind, bodies: [], place: from });
  }
}
