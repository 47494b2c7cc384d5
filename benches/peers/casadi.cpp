// Times the compiled C of CasADi.   casadi FOLDER ROBOT.txt...   (FOLDER holds NAME.so)
#include <dlfcn.h>
#include <cmath>
#include <cstring>
#include "robot_data.hpp"
#include "timing.hpp"

using Function = int (*)(const double **, double **, long long *, double *, int);
using Work = int (*)(long long *, long long *, long long *, long long *);
using Sparsity = const long long *(*)(long long);

static void time_robot(const std::string &folder, const RobotData &robot) {
  void *library = dlopen((folder + "/" + robot.name + ".so").c_str(), RTLD_NOW);
  if (!library) throw std::runtime_error(dlerror());
  const auto &states = robot.states;
  auto symbol = [&](const std::string &name) {
    void *address = dlsym(library, name.c_str());
    if (!address) throw std::runtime_error("no function " + name);
    return address;
  };
  auto run = [&](const std::string &name, const std::string &inputs, bool latency) {
    auto function = reinterpret_cast<Function>(symbol(name));
    long long arguments, results, integers, reals;
    reinterpret_cast<Work>(symbol(name + "_work"))(&arguments, &results, &integers, &reals);
    std::vector<const double *> arg(size_t(arguments) + 1);
    std::vector<double *> res(size_t(results) + 1);
    std::vector<long long> iw(size_t(integers) + 1);
    std::vector<double> w(size_t(reals) + 1), out(size_t(40) * 7 * 70);
    size_t used = 0;
    auto outputs = reinterpret_cast<long long (*)()>(symbol(name + "_n_out"))();
    auto sparsity = reinterpret_cast<Sparsity>(symbol(name + "_sparsity_out"));
    for (long long k = 0; k < outputs; ++k) {
      const long long *s = sparsity(k);
      res[size_t(k)] = out.data() + used;
      used += size_t(s[0] * s[1]);
    }
    std::vector<double> q(states[0].q);
    auto call = [&](size_t i) {
      for (size_t k = 0; k < inputs.size(); ++k)
        arg[k] = (inputs[k] == 'q' ? states[i].q : inputs[k] == 'v' ? states[i].qd : inputs[k] == 'a' ? states[i].qdd : states[i].tau).data();
      if (latency) {
        for (size_t j = 0; j < q.size(); ++j) q[j] = states[i].q[j] + out[0] * 0.0;
        arg[0] = q.data();
      }
      function(arg.data(), res.data(), iw.data(), w.data(), 0);
      observed();
    };
    double error = -1;
    if (name == "inverse_dynamics") {
      double largest = 0, worst = 0;
      for (size_t i = 0; i < states.size(); ++i) {
        call(i);
        for (size_t j = 0; j < q.size() && !latency; ++j) {
          largest = std::max(largest, std::abs(states[i].tau[j]));
          worst = std::max(worst, std::abs(out[j] - states[i].tau[j]));
        }
      }
      if (!latency) error = worst / largest;
    }
    report("casadi", robot.name, (name + (latency ? " latency" : "")).c_str(), nanoseconds(states.size(), call), error);
  };
  run("inverse_dynamics", "qva", false);
  run("mass_matrix", "q", false);
  run("forward_dynamics", "qvt", false);
  run("inverse_dynamics_derivatives", "qva", false);
  run("forward_dynamics_derivatives", "qvt", false);
  run("bias", "qv", false);
  run("gravity", "q", false);
  run("regressor", "qva", false);
  run("pose_and_jacobian", "q", false);
  run("inverse_dynamics", "qva", true);
  run("mass_matrix", "q", true);
  run("forward_dynamics", "qvt", true);
  run("inverse_dynamics_derivatives", "qva", true);
}

int main(int count, char **arguments) {
  for (int i = 2; i < count; ++i) time_robot(arguments[1], read_robot(arguments[i]));
}
