// SPDX-License-Identifier: Apache-2.0
// A worker that ticks: unlike a page's own timers it keeps its time in a hidden tab.
setInterval(() => postMessage('tick'), 100);
