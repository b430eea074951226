// The extension module hooke._hooke. The package in python/hooke wraps it and holds the documentation.
#include <pybind11/pybind11.h>

#include <exception>
#include <utility>

#include "base/build_info.h"
#include "base/option_error.h"
#include "base/printable.h"
#include "base/read_file.h"
#include "python/scene_binding.h"

PYBIND11_MODULE(_hooke, module) {
  using namespace hooke;
  namespace py = pybind11;
  module.doc() = "The modules of Hooke; use the package hooke.";
  module.attr("version") = program_version;

  static py::exception<std::runtime_error> error(module, "Error", PyExc_Exception);
  error.attr("__doc__") = "An error of Hooke: one line, as on the command line.";
  static py::exception<InputError> input(module, "InputError", py::make_tuple(error, py::handle(PyExc_ValueError)));
  input.attr("__doc__") = "Invalid input: a file or a value that a scene may not have.";
  static py::exception<UsageError> usage(module, "UsageError", py::make_tuple(error, py::handle(PyExc_ValueError)));
  usage.attr("__doc__") = "A wrong option or argument.";
  static py::exception<FileError> file(module, "FileError", py::make_tuple(error, py::handle(PyExc_OSError)));
  file.attr("__doc__") = "A file that could not be read or written.";
  static py::exception<MissingFileError> missing(module, "MissingFileError", py::make_tuple(file, py::handle(PyExc_FileNotFoundError)));
  missing.attr("__doc__") = "A file that does not exist.";
  static py::exception<python::UnknownName> unknown(module, "UnknownNameError", py::make_tuple(usage, py::handle(PyExc_KeyError)));
  unknown.attr("__doc__") = "The name of a parameter or of a column that does not exist.";
  // KeyError shows its message in quotes
  unknown.attr("__str__") = py::handle(PyExc_Exception).attr("__str__");
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(std::move(thrown));
    } catch (const InputError& what) {
      input(without_middle(what.what()).c_str());
    } catch (const OptionError& what) {
      usage(without_middle(what.as_argument()).c_str());
    } catch (const python::UnknownName& what) {
      unknown(without_middle(what.what()).c_str());
    } catch (const UsageError& what) {
      usage(without_middle(what.what()).c_str());
    } catch (const MissingFileError& what) {
      missing(without_middle(what.what()).c_str());
    } catch (const FileError& what) {
      file(without_middle(what.what()).c_str());
    }
  });

  python::bind_tables(module);
  python::bind_scene(module);
  python::bind_lab(module);
  python::bind_run(module);
  python::bind_study(module);
  python::bind_sweep(module);
  python::bind_capture(module);
}
