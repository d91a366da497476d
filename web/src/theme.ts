// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';

export type Theme = 'light' | 'dark';

const dark = window.matchMedia('(prefers-color-scheme: dark)');
const paper = window.matchMedia('print');
const listeners = new Set<(theme: Theme) => void>();

/** The chosen theme, or the system's preference; light on paper. */
export function theme(): Theme {
  return paper.matches ? 'light' : chosenTheme();
}

function chosenTheme(): Theme {
  const chosen = localStorage.getItem('theme');
  if (chosen === 'light' || chosen === 'dark') return chosen;
  return dark.matches ? 'dark' : 'light';
}

function apply(): void {
  document.documentElement.dataset['theme'] = theme();
  for (const listener of listeners) listener(theme());
}

/** Calls a listener now and at each change of the theme; returns the function that removes it. */
export function onTheme(listener: (theme: Theme) => void): () => void {
  listeners.add(listener);
  listener(theme());
  return () => listeners.delete(listener);
}

export function startTheme(): void {
  for (const one of [dark, paper]) one.addEventListener('change', apply);
  apply();
}

export function themeSwitch(): HTMLElement {
  const toggle = () => {
    localStorage.setItem('theme', chosenTheme() === 'dark' ? 'light' : 'dark');
    apply();
  };
  return element(
    'button',
    { class: 'quiet', type: 'button', title: 'Light or dark', 'aria-label': 'Light or dark', onclick: toggle },
    '◐',
  );
}
