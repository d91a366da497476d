// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import type { Key } from './keys';
import type { Scene } from './scene/scene';

const bold = 1.8; // factor of lines and texts

/** The picture alone, with thick lines and large texts. The link keeps it. */
export interface Presentation {
  button: HTMLElement;
  /** Leaves it, over the picture. */
  exit: HTMLElement;
  keys: Key[];
  readonly isOn: boolean;
  set(on: boolean): void;
}

export function presentation(page: () => HTMLElement, scene: Scene): Presentation {
  let hadClock = false;
  const presented = {
    isOn: false,
    set: (on: boolean) => {
      if (on === presented.isOn) return;
      presented.isOn = on;
      page().classList.toggle('presenting', on);
      exit.hidden = !on;
      if (on) hadClock = scene.layers().some(({ name, shown }) => name === 'clock' && shown);
      scene.show('clock', on || hadClock);
      scene.keepFree(on ? 16 : 60);
      scene.setBold(on ? bold : 1);
      history.replaceState(history.state, '', linkOf(location.hash, on));
    },
  };
  const exit = element(
    'button',
    {
      type: 'button',
      class: 'exit',
      title: 'Leave the presentation (Esc)',
      hidden: true,
      onclick: () => presented.set(false),
    },
    '✕ Esc',
  );
  const button = element(
    'button',
    {
      type: 'button',
      title: 'The picture alone, with thick lines and large text (p)',
      onclick: () => presented.set(true),
    },
    'Present',
  );
  const keys: Key[] = [
    {
      keys: ['p'],
      shown: 'p',
      does: 'present the picture alone, Esc leaves',
      act: () => presented.set(!presented.isOn),
    },
  ];
  return Object.assign(presented, { button, exit, keys });
}

/** The address of a page with or without the presentation. */
export function linkOf(hash: string, on: boolean): string {
  const bare = hash.replace(/\/present$/, '');
  return on ? `${bare || '#'}/present` : bare;
}
