// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import type { Stage } from './stage';

/** Switches for the scene's layers. */
export function layersTab(stages: Stage[]): { root: HTMLElement; show: () => void } {
  const root = element('div', { class: 'layers' });
  const show = () => {
    const layers = stages[0]?.layers() ?? [];
    root.replaceChildren(
      ...layers.map((layer) => {
        const box = element('input', {
          type: 'checkbox',
          role: 'switch',
          class: 'switch',
          onchange: () => {
            for (const stage of stages) stage.show(layer.name, box.checked);
          },
        });
        box.checked = layer.shown;
        return element('label', { class: 'layer', 'data-layer': layer.name }, box, layer.label);
      }),
    );
  };
  return { root, show };
}
