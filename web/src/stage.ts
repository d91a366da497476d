// SPDX-License-Identifier: Apache-2.0
import { hoverTip } from './hover_tip';
import type { Live } from './live';
import { copyForPaper } from './paper';
import { Scene } from './scene/scene';
import { sceneText } from './scene/words';
import { onTheme } from './theme';

declare global {
  interface Window {
    microswarm?: { scene: Scene; connection: Live }; // for tests
  }
}

/** A scene of a session in the page's theme. */
export interface Stage {
  scene: Scene;
  /** Says what is at the middle of the view, or no longer. */
  sayMiddle(): void;
  destroy(): void;
}

export async function stageFor(live: Live): Promise<Stage> {
  const scene = await Scene.create();
  scene.onWant((request) => void live.ask(request));
  live.listen((message) => scene.take(message));
  const tip = hoverTip(scene);
  scene.root.append(tip.root);
  let described = 0;
  live.listen((message) => {
    if (message.type !== 'frame' || performance.now() < described + 1000) return;
    described = performance.now();
    scene.describe(sceneText(String(live.hello?.scenario['name'] ?? ''), message.frame, message.robots.length / 8));
  });
  let photo: string | undefined;
  live.listen((message) => {
    if (message.type !== 'hello' || message.photo?.file === photo) return;
    photo = message.photo?.file;
    const isServed = photo !== undefined && live.isServed;
    const address = isServed ? `/api/sessions/${live.session}/photo.jpg` : (photo ?? '');
    scene.setBackground(address, [0, 0], message.photo?.um_per_px ?? 1).catch(() => undefined);
  });
  const stopTheme = onTheme((theme) => scene.setTheme(theme));
  const stopPaper = copyForPaper(scene.root); // after the theme's listener, which draws it for paper
  window.microswarm ??= { scene, connection: live };
  return {
    scene,
    sayMiddle: tip.sayMiddle,
    destroy: () => {
      tip.destroy();
      delete window.microswarm;
      stopTheme();
      stopPaper();
      scene.destroy();
    },
  };
}
