// SPDX-License-Identifier: Apache-2.0
import type { Live } from './live';
import { Scene } from './scene/scene';
import { onTheme } from './theme';

/** What the page uses of a scene. */
export interface Stage {
  root: HTMLElement;
  fit(): void;
  zoomBy(factor: number): void;
  follow(on: boolean): void;
  layers(): { name: string; label: string; shown: boolean }[];
  show(name: string, on: boolean): void;
  onTouch(listener: (touch: Touch) => void): void;
  destroy(): void;
}

export type Point = [number, number];
/** A thing of the scene that is dragged, in µm. */
export interface Touch {
  phase: 'begin' | 'move' | 'end';
  what: { kind: 'goal' | 'start' | 'obstacle' | 'map'; index?: number };
  from: Point;
  at: Point;
}

/** A scene that shows a session, in the page's theme. */
export async function stageFor(live: Live): Promise<Stage> {
  const scene: Partial<Stage> & Scene = await Scene.create();
  live.listen((message) => scene.take(message));
  const stopTheme = onTheme((theme) => (scene as { setTheme?(name: string): void }).setTheme?.(theme));
  return {
    root: scene.root,
    fit: () => scene.fit?.(),
    zoomBy: (factor) => scene.zoomBy?.(factor),
    follow: (on) => scene.follow?.(on),
    layers: () => scene.layers?.() ?? [],
    show: (name, on) => scene.show?.(name, on),
    onTouch: (listener) => scene.onTouch?.(listener),
    destroy: () => {
      stopTheme();
      scene.destroy();
    },
  };
}
