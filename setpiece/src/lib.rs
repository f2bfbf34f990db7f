//! setpiece
