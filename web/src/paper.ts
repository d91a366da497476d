// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';

const paper = window.matchMedia('print');

/**
 * Puts a copy of a scene's canvas beside it while the page is printed: browsers print the picture before it, in the
 * colours of the screen. Returns the function that ends it.
 */
export function copyForPaper(root: HTMLElement): () => void {
  let copy: HTMLCanvasElement | undefined;
  const change = () => {
    copy?.remove();
    copy = undefined;
    const drawn = root.querySelector('canvas');
    if (!paper.matches || !drawn) return;
    copy = element('canvas', { class: 'paper', role: 'img', 'aria-label': drawn.getAttribute('aria-label') ?? '' });
    copy.width = drawn.width;
    copy.height = drawn.height;
    copy.getContext('2d')?.drawImage(drawn, 0, 0);
    root.append(copy);
  };
  paper.addEventListener('change', change);
  return () => paper.removeEventListener('change', change);
}
