// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import type { Live } from './live';
import { isUnfolded } from './scene/key';
import type { Scene } from './scene/scene';
import { swatch } from './swatch';
import { onTheme } from './theme';

const period = 400; // ms between looks at what the picture has

/** Names of what the picture shows. */
export interface Legend {
  root: HTMLElement;
  /** Folds or unfolds it. */
  toggle: () => void;
  destroy: () => void;
}

/** The legend below the picture: what this experiment's shown layers have. Folded or not as it was left. */
export function legend(live: Live, scene: Scene): Legend {
  const list = element('ul', {});
  const root = element(
    'details',
    { class: 'legend', ontoggle: () => localStorage.setItem('legend', root.open ? 'open' : 'folded') },
    element('summary', { title: 'Fold or unfold (k)' }, 'Legend'),
    list,
  );
  root.open = isUnfolded(localStorage.getItem('legend'), window.innerWidth);
  let drawn = '';
  let width = 0;
  /** Keeps the list as high as it was at this width, so that the map does not jump when a layer is hidden. */
  const keepHeight = () => {
    if (list.offsetWidth !== width) list.style.minHeight = '';
    width = list.offsetWidth;
    if (root.open) list.style.minHeight = `${list.offsetHeight}px`;
  };
  let timer: number | undefined;
  const show = () => {
    window.clearTimeout(timer);
    timer = undefined;
    const entries = scene.layers().flatMap((layer) => (layer.shown ? layer.entries : []));
    const now = JSON.stringify(entries);
    if (now === drawn) return;
    drawn = now;
    list.replaceChildren(...entries.map((one) => element('li', {}, swatch(one), one.text)));
    keepHeight();
  };
  live.listen((message) => {
    if (message.type === 'hello') drawn = '';
    if (message.type !== 'answer' && message.type !== 'rows')
      timer ??= window.setTimeout(show, drawn === '' ? 0 : period);
  });
  scene.onShow(show);
  const stopTheme = onTheme(show);
  const destroy = () => {
    stopTheme();
    window.clearTimeout(timer);
  };
  return { root, toggle: () => (root.open = !root.open), destroy };
}
