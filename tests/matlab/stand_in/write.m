% SPDX-License-Identifier: Apache-2.0
function write(session, values)
% write  A data acquisition card, which keeps its output in a map.
  session('output') = values;
end
