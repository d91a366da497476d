// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import type { Live } from './live';
import { decisionsNote } from './repeat';
import type { Scene } from './scene/scene';
import { swatch } from './swatch';

const most = 4; // swatches of one layer

/** Switches for the layers that this experiment has, with their looks, and a note on decisions that it lacks. */
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
  let listed = '';
  const show = () => {
    const layers = scenes[0]?.layers() ?? [];
    listed = namesOf(layers);
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
        const looks = element('span', { class: 'looks' }, ...layer.entries.slice(0, most).map(swatch));
        return element(
          'label',
          { class: 'layer', 'data-layer': layer.name, title: layer.help },
          box,
          layer.label,
          looks,
        );
      }),
    );
  };
  let looked = 0;
  scenes[0]?.onPicture(() => {
    if (root.offsetParent === null || performance.now() < looked + 1000) return;
    looked = performance.now();
    if (namesOf(scenes[0]?.layers() ?? []) !== listed) show();
  });
  return { root, show };
}

function namesOf(layers: ReturnType<Scene['layers']>): string {
  return layers.map(({ name, entries }) => `${name} ${entries.length}`).join();
}
