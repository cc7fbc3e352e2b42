/// The four walls as a disc meets them.
#include <gtest/gtest.h>

#include "kernels/walls.hpp"

namespace clathra {
namespace {

TEST(WallFace, LooksFromTheDiscIntoTheWall) {
  Walls walls;
  walls.position[left] = -1, walls.position[right] = 3, walls.position[bottom] = -2, walls.position[top] = 5;
  for (int wall = 0; wall < wall_count; ++wall) walls.velocity[wall] = 10 + wall;
  struct {
    int wall;
    Real nx, ny, distance, vx, vy;
  } const expected[] = {{left, -1, 0, 1.5, 10, 0}, {right, 1, 0, 2.5, 11, 0}, {bottom, 0, -1, 3, 0, 12}, {top, 0, 1, 4, 0, 13}};
  for (auto const& e : expected) {
    WallFace const face = wall_face(walls, e.wall, 0.5, 1.0);
    EXPECT_EQ(face.nx, e.nx) << e.wall;
    EXPECT_EQ(face.ny, e.ny) << e.wall;
    EXPECT_EQ(face.distance, e.distance) << e.wall;
    EXPECT_EQ(face.vx, e.vx) << e.wall;
    EXPECT_EQ(face.vy, e.vy) << e.wall;
  }
  EXPECT_EQ(wall_face(walls, top, 0.0, 5.5).distance, -0.5) << "behind it";
}

}  // namespace
}  // namespace clathra
