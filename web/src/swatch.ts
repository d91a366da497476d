// SPDX-License-Identifier: Apache-2.0
import { css } from './palette';
import type { Entry } from './scene/key';

const space = 'http://www.w3.org/2000/svg';

/** The look of an entry of the legend as a small picture. */
export function swatch({ shape, colour, alpha = 1 }: Entry): SVGSVGElement {
  const svg = document.createElementNS(space, 'svg');
  svg.setAttribute('viewBox', '0 0 26 16');
  svg.setAttribute('class', 'swatch');
  svg.setAttribute('aria-hidden', 'true');
  const draw = (tag: string, attributes: { [name: string]: string | number }) => {
    const one = document.createElementNS(space, tag);
    for (const [name, value] of Object.entries(attributes)) one.setAttribute(name, String(value));
    svg.append(one);
  };
  const paint = css(colour);
  const line = { fill: 'none', stroke: paint, 'stroke-opacity': alpha, 'stroke-linecap': 'round' };
  const area = { fill: paint, 'fill-opacity': alpha };
  if (shape === 'disc') draw('circle', { cx: 13, cy: 8, r: 5.5, ...area });
  else if (shape === 'ring') draw('circle', { cx: 13, cy: 8, r: 6, 'stroke-width': 2, ...line });
  else if (shape === 'dashed')
    draw('circle', { cx: 13, cy: 8, r: 6, 'stroke-width': 2, 'stroke-dasharray': '3 3.3', ...line });
  else if (shape === 'target') {
    draw('circle', { cx: 13, cy: 8, r: 6, 'stroke-width': 2, ...line });
    draw('circle', { cx: 13, cy: 8, r: 2, ...area });
  } else if (shape === 'area') draw('rect', { x: 4, y: 2, width: 18, height: 12, rx: 1, ...area });
  else if (shape === 'band') draw('rect', { x: 0, y: 3, width: 26, height: 10, ...area });
  else if (shape === 'line') draw('path', { d: 'M2 8h22', 'stroke-width': 3, ...line });
  else if (shape === 'tree') draw('path', { d: 'M2 8h8l6 -5h8M10 8l6 5h8', 'stroke-width': 1.5, ...line });
  else if (shape === 'cross') draw('path', { d: 'M9 4l8 8M17 4l-8 8', 'stroke-width': 2.5, ...line });
  else if (shape === 'diamond') draw('path', { d: 'M13 2l6 6l-6 6l-6 -6z', 'stroke-width': 2.5, ...line });
  else draw('path', { d: 'M2 8h21M17 3l6 5l-6 5', 'stroke-width': 3, 'stroke-linejoin': 'round', ...line });
  return svg;
}
