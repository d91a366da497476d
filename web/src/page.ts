// SPDX-License-Identifier: Apache-2.0

/** A page in the window. */
export interface Page {
  root: HTMLElement;
  leave(): void;
  /** Says something in the page's line for it. */
  say?(text: string, isTrouble?: boolean): void;
  /** Reason why no file can be opened from here now; empty if one can. */
  keepsFiles?(): string;
  /** Asks before something is lost by leaving it. */
  mayLeave?(): Promise<boolean>;
  /** Whether something would be lost. */
  isAtRisk?(): boolean;
}
