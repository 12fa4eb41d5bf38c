// Estimator: the Laplacian for lookups of the k nearest photons, to be multiplied by the square of their radius r_k. Queries are
// NARROWEST_LAPLACIAN r_k wide. Given r_k the photons within it are k - 1, independent of each other, and those beyond it any
// number, so that both parts of the sum are right in the mean; but the k-th is always there, where the Laplacian's kernel is
// positive. It is left out, as the estimate of the light itself leaves it out: it would make a bias of 0.15 / (k - 1) of even light.
#define WITHOUT_KTH_PHOTON 1
#include "estimators/laplacian.h"
