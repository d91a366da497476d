// SPDX-License-Identifier: Apache-2.0
// Numbers, units and keys for display.

const units: [string, string][] = [
  ['_um_per_s', 'µm/s'],
  ['_um2_per_s', 'µm²/s'],
  ['_deg_per_s', '°/s'],
  ['_rad_per_s', 'rad/s'],
  ['_um', 'µm'],
  ['_per_s', '1/s'],
  ['_s', 's'],
  ['_deg', '°'],
  ['_rad', 'rad'],
  ['_hz', 'Hz'],
  ['_mT', 'mT'],
  ['_px', 'px'],
];

/** Label and unit of a key: goal_tolerance_um is "goal tolerance" in µm. */
export function words(key: string): { label: string; unit: string } {
  const found = units.find(([end]) => key.endsWith(end));
  const name = found ? key.slice(0, -found[0].length) : key;
  return { label: name.replaceAll('_', ' '), unit: found ? found[1] : '' };
}

/** A number with at most `digits` significant digits, without an exponent if it is short. */
export function number(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return '–';
  const isPlain = value === 0 || (Math.abs(value) >= 1e-4 && Math.abs(value) < 1e6);
  if (!isPlain) return String(Number(value.toPrecision(digits)).toExponential()).replace('e+', 'e');
  return String(Number(value.toPrecision(digits)));
}

/** A number as a person types it, with a decimal point or comma, or why the text is none. */
export function typedNumber(text: string): { value: number } | { trouble: string } {
  const bare = text
    .trim()
    .replace(/^[−–]/, '-')
    .replace(/(?<=\d)[\u0020\u00a0\u202f](?=\d{3}(?!\d))/g, '');
  // Three digits may be thousands: after a point, if they would be odd as decimals, and after a comma.
  if (/^[+-]?[1-9]\d{0,2}(\.\d\d0|(\.\d{3}){2,})$/.test(bare)) {
    const decimal = bare.split('.').length === 2 ? `${Number(bare)} or ` : '';
    return { trouble: `${text.trim()} can be read as two numbers: write ${decimal}${bare.replaceAll('.', '')}.` };
  }
  if (/^[+-]?[1-9]\d*,\d{3}$/.test(bare) || (/^[+-]?[\d.,]+$/.test(bare) && bare.includes(',') && bare.includes('.')))
    return { trouble: `${text.trim()} can be read as two numbers: write it with a decimal point only.` };
  if (!/^[+-]?(\d+[.,]?\d*|[.,]\d+)(e[+-]?\d+)?$/i.test(bare))
    return { trouble: text.trim() === '' ? 'This needs a number.' : `${text.trim()} is no number.` };
  const value = Number(bare.replace(',', '.'));
  return Number.isFinite(value) ? { value } : { trouble: `${text.trim()} is too large a number.` };
}
