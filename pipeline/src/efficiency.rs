//! Which intensity measure to trust: efficiency and sufficiency.

mod covariates;
mod predictor;
mod write;

pub use covariates::covariates;
pub use predictor::{Covariate, Predictor, predictor};
pub use write::{predictors_path, write_predictors};
