// SPDX-License-Identifier: Apache-2.0
// A worker with a timer, which is not throttled in a hidden tab as a page's timers are.
setInterval(() => postMessage('tick'), 100);
