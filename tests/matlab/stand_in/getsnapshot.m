% SPDX-License-Identifier: Apache-2.0
function picture = getsnapshot(camera)
% getsnapshot  A picture of the simulated rig.
  picture = camera.picture();
end
