// SPDX-License-Identifier: Apache-2.0
// The console of a rig, as a function of what is known of it.
import type { Controls, RigStanding, Standing } from './protocol';

const badges = {
  dry: '○ Dry run',
  opening: '… Opening',
  armed: '⚡ ARMED',
  ended: '■ Coils at zero',
  lost: '✕ Connection lost',
  silent: '? Nothing heard',
};

export interface Known {
  rig: RigStanding | undefined;
  controls: Controls | undefined;
  mode: Standing['mode'] | undefined;
  /** Whether the page asked to arm it and has no answer yet. */
  arms: boolean;
  /** Whether the stream is broken. */
  isLost: boolean;
  /** Time since the last message of the rig while it should send some, or 0 [s]. */
  silence: number;
  /** Whether a stop has no answer in time. */
  isStopUnanswered: boolean;
}

interface Shown {
  hidden: boolean;
  disabled: boolean;
  pressed?: boolean;
}

export interface ConsoleView {
  state: keyof typeof badges;
  badge: string;
  words: string;
  /** Whether the coils are or may soon be driven. */
  isHot: boolean;
  buttons: { [name in 'stop' | 'arm' | 'dry' | 'hold' | 'manual' | 'end' | 'take']: Shown };
}

export function consoleOf({ rig, controls, mode, arms, isLost, silence, isStopUnanswered }: Known): ConsoleView {
  const isHot = !isLost && (arms || rig?.state === 'armed' || rig?.state === 'opening');
  const state = isLost ? 'lost' : isSilent(silence) ? 'silent' : arms ? 'opening' : (rig?.state ?? 'opening');
  const holds = controls?.holds ?? false;
  const runs = rig?.state === 'dry' || rig?.state === 'armed';
  const driving = { hidden: !holds || !runs, disabled: isLost };
  const starting = { disabled: isLost || isHot };
  const isUnsure = state === 'ended' && rig?.zero_confirmed === false;
  return {
    state,
    badge: isUnsure ? '■ Stopped, zero not confirmed' : badges[state],
    words: [
      isStopUnanswered ? 'STOP was not answered: use the emergency stop!' : '',
      isLost
        ? 'The lab, or the watchdog of the device, sets the coils to zero. The connection is being opened again.'
        : isSilent(silence)
          ? `Nothing heard for ${Math.floor(silence)} s: what the coils do is not known.`
          : wordsOf(rig, controls),
    ]
      .filter((one) => one !== '')
      .join(' '),
    isHot,
    buttons: {
      stop: { hidden: false, disabled: isLost || !(runs || isHot) },
      arm: { hidden: !holds || rig?.state === 'armed', ...starting },
      dry: { hidden: !holds || rig?.state === 'dry', ...starting },
      hold: { ...driving, pressed: mode === 'hold' },
      manual: { ...driving, pressed: mode === 'manual' },
      end: driving,
      take: { hidden: !(controls?.free ?? false), disabled: isLost },
    },
  };
}

/** Whether a rig, which sends ten messages per second, was not heard for too long. */
export function isSilent(silence: number): boolean {
  return silence >= 1.5;
}

/** Effect of a key, regardless of the focus. */
export function actOf(key: string, isHot: boolean, asks: boolean): 'stop' | 'close' | undefined {
  if (isHot && (key === ' ' || key === 'Escape')) return 'stop';
  return asks && key === 'Escape' ? 'close' : undefined;
}

/** Time and reason of a rig's numbers that are not of now; empty if they are. */
export function staleWords(now: RigStanding, numbers: RigStanding, isLost: boolean, silence = 0): string {
  const at = `${(numbers.t_s ?? 0).toFixed(1)} s`;
  if (isLost) return `Last heard at ${at}: the connection is broken.`;
  if (isSilent(silence)) return `Last heard at ${at}: nothing for ${Math.floor(silence)} s.`;
  if (now.state === 'opening') return `Of the run before, at ${at}: the rig is being opened.`;
  if (now.state !== 'ended') return '';
  const zero =
    now.zero_confirmed === null
      ? 'No current was driven.'
      : now.zero_confirmed
        ? 'The coils are at zero, confirmed by the device.'
        : 'The device has NOT confirmed that its coils are at zero.';
  return `Last before the stop, at ${at}. ${zero}`;
}

/** Ends of a value's bar, as shares of its width. */
export function barOf(value: number, most: number, signed: boolean): { from: number; to: number } {
  const share = Math.max(-1, Math.min(1, value / most));
  if (!signed) return { from: 0, to: Math.max(0, share) };
  return { from: 0.5 + 0.5 * Math.min(0, share), to: 0.5 + 0.5 * Math.max(0, share) };
}

function wordsOf(rig: RigStanding | undefined, controls: Controls | undefined): string {
  const watches =
    controls && !controls.holds && !controls.free ? 'Another page has the controls; this page can stop the rig.' : '';
  if (!rig || rig.state === 'opening') return 'Opening the devices.';
  if (rig.state === 'armed') return watches;
  if (rig.state === 'dry') return watches || 'No current is sent to the coils.';
  const zero =
    rig.zero_confirmed === false
      ? 'NOT CONFIRMED by the device: use its emergency stop!'
      : rig.zero_confirmed
        ? 'Confirmed by the device.'
        : '';
  return [`${sentence(rig.why.replaceAll('_', ' '))}`, zero, rig.stop_trouble, rig.folder && `Record in ${rig.folder}`]
    .filter((one) => one !== '')
    .join(' ');
}

function sentence(text: string): string {
  return text === '' ? '' : `${text[0]?.toUpperCase()}${text.slice(1)}.`;
}
