// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';

/** Takes files that are dropped anywhere in the window, which says so while one is dragged over it. */
export function takeDrops(take: (files: File[]) => void): void {
  const sign = element(
    'div',
    { class: 'drop-here', hidden: true },
    element('strong', {}, 'Drop it: a photograph, a scenario or a record'),
  );
  document.body.append(sign);
  const over = (event: DragEvent) => {
    event.preventDefault();
    sign.hidden = !event.dataTransfer?.types.includes('Files');
  };
  const leave = (event: DragEvent) => {
    if (event.relatedTarget === null) sign.hidden = true;
  };
  const drop = (event: DragEvent) => {
    event.preventDefault();
    sign.hidden = true;
    const files = [...(event.dataTransfer?.files ?? [])];
    if (files.length > 0) take(files);
  };
  window.addEventListener('dragover', over);
  window.addEventListener('dragleave', leave);
  window.addEventListener('drop', drop);
}
