% SPDX-License-Identifier: Apache-2.0
function camera = videoinput(adaptor, device)
% videoinput  The camera of the simulated rig, as the Image Acquisition Toolbox opens one.
  global simulated
  assert(strcmp(adaptor, 'gentl') && device == 1);
  camera = simulated;
end
