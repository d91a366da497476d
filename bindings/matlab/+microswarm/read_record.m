function result = read_record(file)
% microswarm.read_record  Reads the record of a run.
%
%   result = microswarm.read_record('out/run.h5')
%
% result   the struct of microswarm.run: status, metrics, frames, hash
%
% The library reads and checks the file, so that it works without h5read. All other tables
% of a record can be read in MATLAB by h5read; docs/reference/record.md lists them.
% Errors: microswarm:bad_input for a file that is no record.

  % SPDX-License-Identifier: Apache-2.0
  microswarm.internal.need(nargin, 1, 'read_record needs a file');
  file = microswarm.internal.plain_text(file, 'the file');
  stream = fopen(file, 'r');
  if stream < 0, error('microswarm:bad_input', '%s: cannot be opened', file); end
  signature = fread(stream, 8)';
  fclose(stream);
  if ~isequal(signature, [137 double('HDF') 13 10 26 10])
    error('microswarm:bad_input', '%s: is no record, which is an HDF5 file', file);
  end
  result = microswarm.run(file);
end
