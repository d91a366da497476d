// SPDX-License-Identifier: Apache-2.0

/** How the page's scripts are made, beside a server and as static files. */
export const bundled = {
  bundle: true,
  minify: true,
  format: 'esm',
  target: ['chrome110', 'firefox110'],
  legalComments: 'none',
  logLevel: 'warning',
};
