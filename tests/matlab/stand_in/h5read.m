% SPDX-License-Identifier: Apache-2.0
function values = h5read(file, name)
% h5read  As MATLAB's, for a dataset of numbers in a group.
  parts = strsplit(name(2:end), '/');
  group = load('-hdf5', file, parts{1});  % the others may have texts that Octave cannot read
  values = group.(parts{1}).(parts{2})(:);
end
