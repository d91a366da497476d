// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import type { Drive } from './drive';
import type { Key } from './keys';
import type { Live } from './live';
import type { Scene } from './scene/scene';

export interface SceneTools {
  root: HTMLElement;
  keys: Key[];
}

/** Zoom, fit, follow and, with a drive, steer, over the scene and by keys. A rig steers from its console. */
export function sceneTools(live: Live, scene: Scene, drive: Drive | undefined, isRig: boolean): SceneTools {
  let follows = false;
  const toggleFollow = () => scene.follow(!follows);
  const followButton = toolButton('Follow', 'Follow the swarm (l)', toggleFollow);
  const manualButton = toolButton('Steer', 'Steer with the arrow keys or a gamepad (m)', () => drive?.toggle());
  scene.onFollow((on) => {
    follows = on;
    followButton.setAttribute('aria-pressed', String(on));
  });
  live.listen((message) => {
    if (message.type === 'hello') manualButton.hidden = message.playback || isRig;
    if (message.type === 'standing') manualButton.setAttribute('aria-pressed', String(message.mode === 'manual'));
  });
  return {
    root: element(
      'div',
      { class: 'tools' },
      toolButton('−', 'Zoom out', () => scene.zoomBy(1 / 1.25)),
      toolButton('+', 'Zoom in', () => scene.zoomBy(1.25)),
      toolButton('Fit', 'Fit the map (f)', () => scene.fit()),
      followButton,
      ...(drive ? [manualButton] : []),
    ),
    keys: [
      { keys: ['f'], shown: 'f', does: 'fit the map', act: () => scene.fit() },
      { keys: ['l'], shown: 'l', does: 'follow the swarm', act: toggleFollow },
      ...(drive ? [{ keys: ['m'], shown: 'm', does: 'steer by hand', act: () => drive.toggle() }] : []),
    ],
  };
}

export function toolButton(label: string, title: string, act: () => void): HTMLButtonElement {
  return element('button', { type: 'button', title, onclick: act }, label);
}
