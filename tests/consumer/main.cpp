/// A program outside of Clathra: two discs collide, and part at the speed at which they met.
#include <cmath>
#include <cstdio>

#include "domain/simulation/simulation.hpp"

int main(int argc, char** argv) {
  Kokkos::ScopeGuard const kokkos(argc, argv);
  double const radius = 1e-4, speed = 1e-3;
  clathra::Specimen specimen;
  specimen.left = specimen.bottom = -1, specimen.right = specimen.top = 1;
  specimen.id = {0, 1};
  specimen.x = {-radius, radius}, specimen.vx = {speed / 2, -speed / 2}, specimen.radius = {radius, radius};
  specimen.y = specimen.vy = specimen.angle = specimen.omega = {0, 0};
  clathra::SimulationLaws laws;
  laws.motion.damping = 0;
  clathra::Simulation simulation(specimen, laws, radius / 10);
  simulation.time_step = 1e-8;
  for (int step = 0; step < 500; ++step) simulation.step();
  clathra::Specimen const after = simulation.specimen();
  std::printf("met at %g m/s, parted at %.6g m/s\n", speed, after.vx[1] - after.vx[0]);
  return std::fabs(after.vx[1] - after.vx[0] - speed) < 1e-3 * speed ? 0 : 1;
}
