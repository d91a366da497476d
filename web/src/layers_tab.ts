// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import type { Live } from './live';
import { decisionsNote } from './repeat';
import type { Scene } from './scene/scene';

/** Switches for the scene's layers, and a note on decisions that the session does not have. */
export function layersTab(scenes: Scene[], live?: Live): { root: HTMLElement; show: () => void } {
  const list = element('div', { class: 'layers' });
  const note = element('p', { class: 'when', role: 'status', hidden: true });
  const root = element('div', {}, note, list);
  live?.listen((message) => {
    if (message.type !== 'standing') return;
    const text = decisionsNote(message);
    note.hidden = text === '';
    if (note.textContent !== text) note.textContent = text;
  });
  const show = () => {
    const layers = scenes[0]?.layers() ?? [];
    list.replaceChildren(
      ...layers.map((layer) => {
        const box = element('input', {
          type: 'checkbox',
          role: 'switch',
          class: 'switch',
          onchange: () => {
            for (const scene of scenes) scene.show(layer.name, box.checked);
          },
        });
        box.checked = layer.shown;
        return element('label', { class: 'layer', 'data-layer': layer.name, title: layer.help }, box, layer.label);
      }),
    );
  };
  return { root, show };
}
