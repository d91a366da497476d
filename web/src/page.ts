// SPDX-License-Identifier: Apache-2.0

/** A page in the window. */
export interface Page {
  root: HTMLElement;
  leave(): void;
  /** Asks before something is lost by leaving it. */
  mayLeave?(): Promise<boolean>;
  /** Whether something would be lost. */
  isAtRisk?(): boolean;
}
