// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';

export interface Tab {
  name: string;
  panel: HTMLElement;
  /** Called when the panel becomes visible. */
  shown?: () => void;
}

/** Tabs with the keys of the ARIA pattern: arrows, Home, End. The tab of the last visit is selected. */
export function tabs(id: string, list: Tab[]): HTMLElement {
  const buttons = list.map((tab, i) =>
    element(
      'button',
      {
        role: 'tab',
        type: 'button',
        id: `${id}-tab-${i}`,
        'aria-controls': `${id}-panel-${i}`,
        onclick: () => show(i),
      },
      tab.name,
    ),
  );
  const panels = list.map((tab, i) =>
    element(
      'div',
      { role: 'tabpanel', class: 'panel', tabindex: '0', id: `${id}-panel-${i}`, 'aria-labelledby': `${id}-tab-${i}` },
      tab.panel,
    ),
  );
  const show = (at: number) => {
    sessionStorage.setItem(`tab-${id}`, String(at));
    buttons.forEach((button, i) => {
      button.setAttribute('aria-selected', String(i === at));
      button.tabIndex = i === at ? 0 : -1;
    });
    panels.forEach((panel, i) => (panel.hidden = i !== at));
    list[at]?.shown?.();
  };
  const move = (event: Event) => {
    const key = (event as KeyboardEvent).key;
    const here = buttons.indexOf(document.activeElement as HTMLButtonElement);
    const to = { ArrowLeft: here - 1, ArrowRight: here + 1, Home: 0, End: list.length - 1 }[key];
    if (to === undefined || here < 0) return;
    event.preventDefault();
    event.stopPropagation();
    const next = (to + list.length) % list.length;
    show(next);
    buttons[next]?.focus();
  };
  const bar = element('div', { role: 'tablist', class: 'tablist', onkeydown: move }, ...buttons);
  const first = Number(sessionStorage.getItem(`tab-${id}`) ?? 0);
  show(first < list.length ? first : 0);
  return element('div', { class: 'tabs' }, bar, ...panels);
}
