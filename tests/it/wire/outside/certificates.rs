//! Certificates of an authority, for runs and their clients.

use rcgen::{BasicConstraints, CertificateParams, CertifiedIssuer, DnType, IsCa, KeyPair, KeyUsagePurpose};
use std::fs;
use std::path::Path;

/// Whoever signs certificates.
pub(super) struct Authority(CertifiedIssuer<'static, KeyPair>);

impl Authority {
    pub(super) fn new(name: &str) -> Self {
        let mut params = CertificateParams::default();
        params.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
        params.key_usages = vec![KeyUsagePurpose::KeyCertSign];
        params.distinguished_name.push(DnType::CommonName, name);
        let key = KeyPair::generate().expect("a key");
        Self(CertifiedIssuer::self_signed(params, key).expect("its own certificate"))
    }

    /// Writes its certificate.
    pub(super) fn write(&self, dir: &Path, file: &str) {
        fs::write(dir.join(file), self.0.pem()).expect("the folder is ours");
    }

    /// Writes `<name>.pem` and `<name>.key`: a certificate with this common name for the loopback address.
    pub(super) fn sign(&self, dir: &Path, name: &str) {
        let mut params = CertificateParams::new(["127.0.0.1".to_string()]).expect("an address");
        params.distinguished_name.push(DnType::CommonName, name);
        let key = KeyPair::generate().expect("a key");
        let signed = params.signed_by(&key, &self.0).expect("signed");
        fs::write(dir.join(format!("{name}.pem")), signed.pem()).expect("the folder is ours");
        fs::write(dir.join(format!("{name}.key")), key.serialize_pem()).expect("the same");
    }
}
