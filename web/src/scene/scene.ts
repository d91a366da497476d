// SPDX-License-Identifier: Apache-2.0
import 'pixi.js/unsafe-eval'; // the page's policy forbids the evaluation of texts
import { Application, Container, Graphics } from 'pixi.js';
import { type Bodies, type Frame, type Hello, type Message, floats } from '../protocol';

/** The map and what moves in it, drawn from the stream alone. World coordinates are µm, y up. */
export class Scene {
  readonly root: HTMLElement;
  private readonly world = new Container();
  private readonly walls = new Graphics();
  private readonly bodies = new Graphics();
  private readonly swarm = new Graphics();

  static async create(): Promise<Scene> {
    const app = new Application();
    await app.init({ background: '#ffffff', antialias: true, preference: 'webgl', autoDensity: true });
    return new Scene(app);
  }

  private constructor(private readonly app: Application) {
    this.root = document.createElement('div');
    this.root.className = 'scene';
    this.root.append(app.canvas);
    app.resizeTo = this.root;
    this.world.addChild(this.walls, this.bodies, this.swarm);
    app.stage.addChild(this.world);
  }

  destroy(): void {
    this.app.destroy(true, { children: true });
  }

  take(message: Message): void {
    if (message.type === 'hello') this.takeMap(message);
    if (message.type === 'frame') this.takeFrame(message);
  }

  private takeMap(hello: Hello): void {
    this.app.resize();
    const [x0, y0] = hello.map.lo;
    const [x1, y1] = hello.map.hi;
    const { width, height } = this.app.screen;
    const scale = 0.95 * Math.min(width / (x1 - x0), height / (y1 - y0));
    this.world.scale.set(scale, -scale);
    this.world.position.set(width / 2 - (scale * (x0 + x1)) / 2, height / 2 + (scale * (y0 + y1)) / 2);
    this.walls.clear();
    this.walls.rect(x0, y0, x1 - x0, y1 - y0).stroke({ width: 2 / scale, color: 0x444444 });
    drawBodies(this.walls, hello.map.walls, 0x777777);
  }

  private takeFrame(message: Frame): void {
    this.bodies.clear();
    drawBodies(this.bodies, message.bodies, 0xd55e00);
    const { x_um, y_um, radius_um } = message.frame;
    this.swarm.clear();
    this.swarm.circle(Number(x_um), Number(y_um), Number(radius_um)).fill(0x0072b2);
  }
}

function drawBodies(to: Graphics, bodies: Bodies, color: number): void {
  const discs = floats(bodies.discs);
  for (let i = 0; i + 3 < discs.length; i += 4)
    to.circle(discs[i] as number, discs[i + 1] as number, discs[i + 2] as number).fill(color);
  for (const polygon of bodies.polygons) {
    to.poly([...floats(polygon.outer)]).fill(color);
    for (const hole of polygon.holes) to.poly([...floats(hole)]).cut();
  }
}
