#include "core/assessment/places.h"

#include <algorithm>
#include <cmath>

#include "core/identification/prediction.h"

namespace truepose {
namespace {

struct Visit {
  int id, row;
  Eigen::Vector3d p_BT;
};

struct Place {
  int placement;
  Eigen::Vector3d p_M;  // in the fixture
  std::vector<Visit> visits;

  Eigen::Vector3d Mean() const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Visit& visit : visits) sum += visit.p_BT;
    return sum / static_cast<double>(visits.size());
  }
};

std::vector<Place> PlacesOf(const Problem& problem, const Estimate& estimate) {
  std::vector<Place> places;
  for (const Reading& reading : problem.readings) {
    if (!reading.contact || PositionRowsOf(reading) != 3) continue;
    auto place = std::find_if(places.begin(), places.end(), [&](const Place& known) {
      return known.placement == reading.placement && known.p_M == reading.X_MT.p;
    });
    if (place == places.end())
      place = places.insert(places.end(), {reading.placement, reading.X_MT.p, {}});
    const Pose X_BT =
        Inverse(estimate.X_MB[reading.placement]) * Predict(problem, reading, estimate);
    place->visits.push_back({reading.id, reading.row, X_BT.p});
  }
  return places;
}

double LargestSpacingError(const std::vector<Place>& places) {
  double largest = 0;
  for (size_t i = 0; i < places.size(); ++i) {
    for (size_t j = i + 1; j < places.size(); ++j) {
      if (places[i].placement != places[j].placement) continue;
      const double predicted = (places[i].Mean() - places[j].Mean()).norm();
      largest = std::max(largest, std::abs(predicted - (places[i].p_M - places[j].p_M).norm()));
    }
  }
  return largest;
}

}  // namespace

PlaceErrors PlaceErrorsOf(const Problem& problem, const Estimate& estimate) {
  const std::vector<Place> places = PlacesOf(problem, estimate);
  PlaceErrors result;
  for (const Place& place : places) {
    if (place.visits.size() < 2) continue;
    const Eigen::Vector3d mean = place.Mean();
    for (const Visit& visit : place.visits)
      result.errors.push_back({visit.id, (visit.p_BT - mean).norm(), -1, visit.row});
  }
  result.largest_spacing_error_m = LargestSpacingError(places);
  return result;
}

}  // namespace truepose
