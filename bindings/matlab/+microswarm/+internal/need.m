function need(given, count, what)
% microswarm.internal.need  Refuses a call that has fewer than `count` arguments; `what` says which there must be.

  % SPDX-License-Identifier: Apache-2.0
  if given < count, error('microswarm:bad_call', '%s', what); end
end
