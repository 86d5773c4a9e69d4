#include "sim/physics/small_cholesky.h"

#include <gtest/gtest.h>

#include "nonet/math/random.h"

namespace nonet::sim {
namespace {

Matrix6 drawn(Random& random) {
  Matrix6 matrix;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) matrix(i, j) = random.uniform(-1.0, 1.0);
  }
  return matrix;
}

Matrix6 positiveDefinite(Random& random) {
  const Matrix6 root = drawn(random);
  return root * root.transpose() + 0.1 * Matrix6::Identity();
}

TEST(SmallCholesky, SolvesAsEigenToTheLastBit) {
  Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const Matrix6 matrix = positiveDefinite(random);
    const Matrix6 right = drawn(random);
    const Eigen::LLT<Matrix6> eigen(matrix);
    EXPECT_EQ(SmallCholesky(eigen).solve(right), Matrix6(eigen.solve(right)));
  }
}

TEST(SmallCholesky, InvertsAsItSolvesForTheIdentity) {
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Matrix6 matrix = positiveDefinite(random);
    const SmallCholesky factors(matrix);
    EXPECT_EQ(factors.inverse(), factors.solve(Matrix6::Identity())) << "the same bits";
    EXPECT_TRUE((matrix * factors.inverse()).isIdentity(1e-9));
  }
}

}  // namespace
}  // namespace nonet::sim
