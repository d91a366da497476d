% SPDX-License-Identifier: Apache-2.0
function axis(style)
% axis  Of a plot that is not drawn.
  assert(strcmp(style, 'equal'));
end
