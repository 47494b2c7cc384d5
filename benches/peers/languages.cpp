// Times inverse dynamics in Rust, in C by two compilers, and in CasADi's C, in turn in one process.
//
//   languages JOINTS ROUNDS NAME=LIBRARY:SYMBOL...
//
// The others are compared with the first one; those named casadi have CasADi's interface. Prints the least time of
// a call over all rounds, its ratio to that of the first, and whether the results have the same bits as those of
// the first.
#include <dlfcn.h>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

using Plain = void (*)(const double *, const double *, const double *, double *);
using Casadi = int (*)(const double **, double **, long long *, double *, int);
using Work = int (*)(long long *, long long *, long long *, long long *);

struct Contender {
  std::string name;
  Plain plain = nullptr;
  Casadi casadi = nullptr;
  std::vector<const double *> arg;
  std::vector<double *> res;
  std::vector<long long> iw;
  std::vector<double> w;
  double least = 1e30;
  std::vector<double> torques;

  void call(const double *q, const double *qd, const double *qdd, double *tau) {
    if (plain) return plain(q, qd, qdd, tau);
    arg[0] = q, arg[1] = qd, arg[2] = qdd, res[0] = tau;
    casadi(arg.data(), res.data(), iw.data(), w.data(), 0);
  }
};

static Contender contender(const std::string &text) {
  const auto equals = text.find('='), colon = text.rfind(':');
  const std::string library = text.substr(equals + 1, colon - equals - 1), symbol = text.substr(colon + 1);
  void *handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) throw std::runtime_error(dlerror());
  void *function = dlsym(handle, symbol.c_str());
  if (!function) throw std::runtime_error(dlerror());
  Contender found;
  found.name = text.substr(0, equals);
  if (found.name.rfind("casadi", 0) != 0) {
    found.plain = reinterpret_cast<Plain>(function);
    return found;
  }
  found.casadi = reinterpret_cast<Casadi>(function);
  long long arguments, results, integers, reals;
  reinterpret_cast<Work>(dlsym(handle, (symbol + "_work").c_str()))(&arguments, &results, &integers, &reals);
  found.arg.resize(size_t(arguments) + 3), found.res.resize(size_t(results) + 1);
  found.iw.resize(size_t(integers) + 1), found.w.resize(size_t(reals) + 1);
  return found;
}

int main(int count, char **arguments) {
  const size_t joints = std::strtoul(arguments[1], nullptr, 10), states = 64, repeated = 16;
  const long rounds = std::strtol(arguments[2], nullptr, 10);
  std::vector<Contender> all;
  for (int i = 3; i < count; ++i) all.push_back(contender(arguments[i]));
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-3, 3);
  std::vector<double> state(3 * states * joints), tau(states * joints);
  for (double &number : state) number = uniform(random);
  const double *q = state.data(), *qd = q + states * joints, *qdd = qd + states * joints;
  auto batch = [&](Contender &one) {
    const auto start = std::chrono::steady_clock::now();
    for (size_t round = 0; round < repeated; ++round)
      for (size_t i = 0; i < states * joints; i += joints) {
        one.call(q + i, qd + i, qdd + i, &tau[i]);
        asm volatile("" ::: "memory");
      }
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - start;
    return took.count() / double(repeated * states);
  };
  for (Contender &one : all) {
    batch(one);
    one.torques = tau;
  }
  for (long round = 0; round < rounds; ++round)
    for (Contender &one : all) one.least = std::min(one.least, batch(one));
  for (const Contender &one : all) {
    const bool same = !std::memcmp(one.torques.data(), all[0].torques.data(), tau.size() * sizeof(double));
    std::printf("  %-26s %8.2f ns %6.3f  %s\n", one.name.c_str(), one.least, one.least / all[0].least,
                same ? "same bits" : "other bits");
  }
}
