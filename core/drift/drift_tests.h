// Probabilities of sums of squares if nothing has changed.
//
// Chi-square of the check falls into what all parts together can explain, `drop` on k degrees of
// freedom, and the rest on m. Each is tested by itself, since drift of a part is a few directions
// among hundreds of rows and would drown in their sum:
//   drop   (drop / k) / max(1, rest / m) is F(k, nu) at most, nu the redundancy that the
//          unexplained residual was estimated from. The rest takes part so that a session that
//          scatters more all over does not look like a motion of everything.
//   rest   rest / m has mean 1 and a variance of 2/m, or what the readings' own sums of squares
//          show when that is more (unexplained residuals have long tails), and 2/nu on top for
//          s_model itself; taken for chi-square with as many degrees of freedom as have that
//          variance (Satterthwaite).
// The p value of both is twice the lesser one (Bonferroni).
#pragma once

#include <Eigen/Core>

#include "core/identification/problem.h"

namespace truepose {

struct DriftSums {
  double drop = 0, rest = 0;
  int drop_freedom = 0, rest_freedom = 0;
  int redundancy = 0;                // nu; 0 = infinite
  Eigen::VectorXd rest_of_readings;  // the rest, by reading

  // Of the unexplained residual, at least 1.
  double Scale() const { return std::max(1.0, rest / rest_freedom); }
};

double DropProbability(const DriftSums& sums, double drop, int freedom);
double RestProbability(const DriftSums& sums);
// Both together.
double ChangeProbability(const DriftSums& sums);

// |r|^2 of the rows of each reading.
Eigen::VectorXd SumsOfReadings(const Problem& problem, const Eigen::VectorXd& r);

}  // namespace truepose
