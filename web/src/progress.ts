// SPDX-License-Identifier: Apache-2.0

/** Shows how far something is; a screen reader does not read each of these texts aloud. */
export function showProgress(output: HTMLOutputElement, text: string): void {
  output.setAttribute('aria-live', 'off');
  output.value = text;
}

/** Shows a beginning or an outcome, which is read aloud. */
export function showOutcome(output: HTMLOutputElement, text: string): void {
  output.removeAttribute('aria-live');
  output.value = text;
}
