// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <fstream>
#include <memory>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/sweep/export.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

struct ExportOptions {
  std::string file;
  std::string csv;
  std::string hdf5;
  std::string ompl;
  std::string table = "frames";
};

/// Whether the file starts like an HDF5 file. The database reader rejects other files. Throws
/// InputError if it cannot be read.
bool is_hdf5(const std::string& file) {
  std::array<char, 4> first{};
  std::ifstream in(file, std::ios::binary);
  if (!in) read_file(file);  // throws
  in.read(first.data(), first.size());
  return std::string_view(first.data(), first.size()) == "\x89HDF";
}

void export_record(const ExportOptions& o) {
  if (!o.hdf5.empty()) throw InputError(o.file, "is already HDF5: give --csv");
  if (!o.ompl.empty()) throw InputError(o.file, "--ompl takes the database of a sweep");
  write_file_atomically(o.csv, sweep::record_csv(experiment::read_record(o.file), o.table));
  print("wrote {}\n", o.csv);
}

void export_sweep(const ExportOptions& o) {
  if (!o.table.empty() && o.table != "frames")
    throw InputError(o.file, "--table takes the record of a run");
  const sweep::SweepReader sweep(o.file);
  if (!o.csv.empty()) {
    write_file_atomically(o.csv, sweep::sweep_csv(sweep));
    print("wrote {}\n", o.csv);
  }
  if (!o.hdf5.empty()) {
    write_file_atomically(o.hdf5, sweep::sweep_hdf5(sweep));
    print("wrote {}\n", o.hdf5);
  }
  if (o.ompl.empty()) return;
  const OutFolder hold(o.ompl);
  const auto logs = sweep::ompl_logs(sweep);
  for (const auto& [name, log] : logs)
    write_file_atomically(std::filesystem::path(o.ompl) / name, log);
  print("wrote {} logs into {}\n", logs.size(), o.ompl);
}

int export_command(const ExportOptions& o) {
  if (o.csv.empty() && o.hdf5.empty() && o.ompl.empty())
    throw InputError("export: nothing to write: give --csv, --hdf5 or --ompl");
  keep_input(o.csv, o.file);
  keep_input(o.hdf5, o.file);
  is_hdf5(o.file) ? export_record(o) : export_sweep(o);
  return ok;
}

}  // namespace

void add_export(Command app, Action& action) {
  auto o = std::make_shared<ExportOptions>();
  Command cmd = app.add_command(
      "export", "Export a sweep's database, or a table of a run's record, to other formats",
      "export out/first_flight.db --csv trials.csv --hdf5 trials.h5 --ompl logs");
  cmd.add_option("file", o->file, "Database of a sweep or record of a run (run.h5)")
      .required()
      .type_name("FILE")
      .input();
  cmd.add_option("--csv", o->csv, "Write CSV with units in the column names").type_name("FILE");
  cmd.add_option("--hdf5", o->hdf5, "Write HDF5 with one dataset per column").type_name("FILE");
  cmd.add_option("--ompl", o->ompl,
                 "Write OMPL benchmark logs to this folder, one per combination of parameters")
      .type_name("FOLDER");
  cmd.add_option("--table", o->table,
                 "Table of a record: frames, events, paths/points, diagnostics/radar, ...")
      .type_name("NAME");
  cmd.callback([o, &action] { action = [o](const Context&) { return export_command(*o); }; });
}

}  // namespace microswarm::cli
