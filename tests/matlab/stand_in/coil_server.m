% SPDX-License-Identifier: Apache-2.0
function coil_server(port, apply)
% coil_server  A server that gets one message. OwnDriver.TheServerForMatlabRunsInOctave runs the true one.
  assert(port == 5025);
  apply([1 -2]);
end
