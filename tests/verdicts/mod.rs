//! The verdicts of a report against those expected.

use subcert::paper::{Report, Verdict};

/// Every claim of the report is named once, with its verdict.
pub fn are(report: &Report, expected: &[(Verdict, &str)]) {
    let mut count = 0;
    for (verdict, ids) in expected {
        for id in ids.split_whitespace() {
            let claim = report.claim(id).unwrap_or_else(|| panic!("no claim {id}"));
            assert_eq!(claim.verdict, *verdict, "{id}: {}", claim.found);
            count += 1;
        }
    }
    assert_eq!(count, report.claims.len());
}
