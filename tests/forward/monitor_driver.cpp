// Feeds the C++ core of a monitor with models and observations as text, and says what it finds.
#include <cstdint>
#include <iostream>
#include <string>

#include "monitored/monitor_run.h"

namespace {

using namespace monitored::monitoring;  // NOLINT

template <class T>
T read() {
  T value{};
  std::cin >> value;
  return value;
}

std::string readText() {
  std::string line;
  std::getline(std::cin >> std::ws, line);
  return line.substr(1);  // a colon, so that an empty text has something to read
}

Cells readCells() {
  Cells cells(read<std::size_t>());
  for (Cell& cell : cells) std::cin >> cell;
  return cells;
}

std::vector<Variable> readVariables() {
  std::vector<Variable> found(read<std::size_t>());
  for (Variable& v : found) {
    v.name = readText();
    v.kind = static_cast<Kind>(read<int>());
    v.lengths = readCells();
  }
  return found;
}

Model readModel() {
  Model model;
  model.code.resize(read<std::size_t>());
  for (Instruction& i : model.code) {
    i.op = static_cast<Op>(read<int>());
    std::cin >> i.a >> i.b;
    i.table = readCells();
  }
  model.texts.resize(read<std::size_t>());
  for (std::string& text : model.texts) text = readText();
  model.bodies.resize(read<std::size_t>());
  for (Body& b : model.bodies) std::cin >> b.entry >> b.frame >> b.parameters;
  model.servers.resize(read<std::size_t>());
  for (Server& s : model.servers) {
    s.name = readText();
    std::cin >> s.body >> s.priority >> s.reads_sender;
    s.parameters = readVariables();
  }
  model.rebecs.resize(read<std::size_t>());
  for (Rebec& r : model.rebecs) {
    r.name = readText();
    r.node = readText();
    std::cin >> r.class_number >> r.capacity >> r.priority >> r.constructor;
    r.known = readCells();
    r.state = readVariables();
    r.arguments = readCells();
    r.dispatch = readCells();
  }
  std::cin >> model.global_ranks;
  return model;
}

Observation readObservation() {
  Observation seen;
  std::cin >> seen.rebec;
  seen.server = readText();
  seen.arguments = readText();
  std::cin >> seen.arrival >> seen.start >> seen.now;
  seen.variables = readCells();
  return seen;
}

}  // namespace

int main() {
  for (std::size_t models = read<std::size_t>(); models > 0; models--) {
    const Model model = readModel();
    for (std::size_t runs = read<std::size_t>(); runs > 0; runs--) {
      Run run(model);
      for (std::size_t count = read<std::size_t>(); count > 0; count--) {
        run.receive(readObservation());
        run.compare();
      }
      std::cout << run.compared() << ' ' << run.waiting() << ' ' << run.hypotheses();
      if (run.deviation() != nullptr) {
        const Deviation& found = *run.deviation();
        std::cout << " deviation " << found.rebec << '|' << found.step << '|' << found.observed;
      }
      std::cout << ' ' << run.doubt() << '\n';
    }
  }
  return 0;
}
