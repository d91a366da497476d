// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import type { Scene } from './scene/scene';
import { swatch } from './swatch';

const most = 4; // swatches of one layer

/** Switches for the layers that this experiment has, with their looks. */
export function layersTab(scenes: Scene[]): { root: HTMLElement; show: () => void } {
  const root = element('div', { class: 'layers' });
  let listed = '';
  const show = () => {
    const layers = scenes[0]?.layers() ?? [];
    listed = namesOf(layers);
    root.replaceChildren(
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
