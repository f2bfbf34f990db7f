//! Many environments at once.
