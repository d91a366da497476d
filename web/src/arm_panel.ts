// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import { number } from './numbers';
import type { RigInfo } from './protocol';

export interface ArmPanel {
  root: HTMLElement;
  open(info: RigInfo | undefined): void;
  close(): void;
}

/** The question before the coils are driven: what will be driven, within which limits. */
export function armPanel(arm: () => void): ArmPanel {
  const facts = element('ul', {});
  const close = () => {
    root.hidden = true;
  };
  const button = (label: string, name: string, act: () => void) =>
    element('button', { type: 'button', class: name, onclick: act }, label);
  const cancel = button('Cancel', 'cancel', close);
  const confirm = button('Arm: drive the coils', 'danger', () => {
    close();
    arm();
  });
  const root = element(
    'div',
    { class: 'arm-panel', role: 'alertdialog', 'aria-label': 'Arm the rig', hidden: true },
    element('strong', {}, 'Drive the coils?'),
    facts,
    element('div', { class: 'row' }, cancel, confirm),
  );
  return {
    root,
    close,
    open: (info) => {
      facts.replaceChildren(...factsOf(info).map((one) => element('li', {}, one)));
      root.hidden = false;
      cancel.focus();
    },
  };
}

/** Facts shown before the coils are driven. */
export function factsOf(info: RigInfo | undefined): string[] {
  if (!info) return [];
  const limit = (values: (number | null)[], unit: string) => {
    const known = values.filter((one): one is number => one !== null);
    return known.length > 0 ? `at most ${number(Math.max(...known))} ${unit}` : `no limit in ${unit}`;
  };
  return [
    `${info.name}: ${info.coils.length} ${info.real_coils ? 'coils are driven by a device' : 'simulated coils'}, ${info.real_camera ? 'a real camera' : 'a simulated camera'}`,
    `Field of ${number(info.field_mt)} mT; ${limit(info.max_current_a, 'A')}, ${limit(info.max_temperature_c, '°C')}`,
    'Space, Esc, the button and closing this page stop it.',
    ...info.warnings,
  ];
}
